#include "problem/potential.hpp"

#include "clock.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/effect/input.hpp"

namespace hbvm::core {
namespace {

template <class S>
class PotentialTest : public InDigits<50> {
 protected:
  static constexpr Index d = 2, m = 4;
  RandomValues<S> random{73};

  using Use = EffectInput<S>;
  using Instance = typename Use::Instance;

  static Instance instance(const Displacement<S>& x, int mass) {
    Instance result;
    result.x = x;
    result.mass_matrix = Matrix<S>::Identity(d, d) * S(mass);
    result.masses[0] = result.masses[1] = S(mass);
    return result;
  }
  static Displacement<S> body(Index number) { return {{{number * d, S(1)}}, {}}; }
  static Displacement<S> pair() { return {{{0, S(1)}, {d, S(-1)}}, {}}; }

  static EffectTerm<S> gravity() {
    Use input{
        "uniform_gravity", d, {}, {{"acceleration", {S(2), S(-3)}}}, {instance(body(0), 1), instance(body(1), 5)}};
    return make_term(input);
  }
  static EffectTerm<S> attraction(int strength = 2) {
    return make_term(Use{"mutual_gravity", d, {{"strength", S(strength)}}, {}, {instance(pair(), 3)}});
  }
  static EffectTerm<S> trap() {
    return make_term(
        Use{"trap", d, {{"stiffness", S(4)}, {"exponent", S(2)}}, {}, {instance(body(0), 1), instance(body(1), 1)}});
  }
  static Potential<S> potential(std::vector<EffectTerm<S>> terms) { return {d, m, std::move(terms)}; }

  static Matrix<S> varying_force(const Potential<S>& potential, const Matrix<S>& q) {
    PotentialEvaluator<S> evaluator(potential, q.rows());
    Matrix<S> force;
    evaluator.varying_force(lanes(q), force);
    return force;
  }
  static Vector<S> values(const Potential<S>& potential, const Matrix<S>& q) {
    PotentialEvaluator<S> evaluator(potential, q.rows());
    Vector<S> U;
    evaluator.values(lanes(q), U);
    return U;
  }

  Matrix<S> apart(Index lanes) {
    Matrix<S> q = random.matrix(lanes, m);
    q.leftCols(2).array() += S(3);
    return q;
  }
};
TYPED_TEST_SUITE(PotentialTest, AllScalars, ScalarNames);

TYPED_TEST(PotentialTest, ConstantForceIsEvaluatedOnce) {
  const auto U = this->potential({this->gravity()});
  PotentialEvaluator<TypeParam> evaluator(U, 3);
  EXPECT_FALSE(evaluator.has_varying_force());
  Vector<TypeParam> expected(4);
  expected << TypeParam(2), TypeParam(-3), TypeParam(10), TypeParam(-15);
  EXPECT_EQ(evaluator.constant_force(), expected);
  Matrix<TypeParam> force = this->random.matrix(3, 4);
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Matrix<TypeParam> q = this->apart(3);
    evaluator.varying_force(lanes(q), force);
    EXPECT_EQ(force, (Matrix<TypeParam>(Matrix<TypeParam>::Zero(3, 4))));
  }
  ASSERT_EQ(evaluator.counts().size(), 1u);
  EXPECT_EQ(evaluator.counts()[0].calls, 1u);
  EXPECT_EQ(evaluator.counts()[0].evaluations, 1u);
}

TYPED_TEST(PotentialTest, CountsCallsAndEvaluations) {
  const auto U = this->potential({this->gravity(), this->attraction()});
  PotentialEvaluator<TypeParam> evaluator(U, 3);
  EXPECT_TRUE(evaluator.has_varying_force());
  Matrix<TypeParam> force;
  Vector<TypeParam> values;
  const Matrix<TypeParam> q = this->apart(3);
  for (int call = 0; call < 4; ++call) evaluator.varying_force(lanes(q), force);
  evaluator.values(lanes(q), values);
  EXPECT_EQ(evaluator.counts()[0].calls, 1u);
  EXPECT_EQ(evaluator.counts()[1].calls, 4u);
  EXPECT_EQ(evaluator.counts()[1].evaluations, 12u);
}

TYPED_TEST(PotentialTest, TheForceIsTheVaryingOneAndTheConstantOne) {
  const auto U = this->potential({this->gravity(), this->trap()});
  PotentialEvaluator<TypeParam> evaluator(U, 2);
  const Matrix<TypeParam> q = this->apart(2);
  Matrix<TypeParam> force, varying;
  evaluator.force(lanes(q), force);
  evaluator.varying_force(lanes(q), varying);
  for (Index j = 0; j < 4; ++j)
    for (Index i = 0; i < 2; ++i) EXPECT_EQ(force(i, j), TypeParam(varying(i, j) + evaluator.constant_force()[j]));
}

TYPED_TEST(PotentialTest, CountsOperationsOfAnEvaluation) {
  const auto U = this->potential({this->attraction()});
  const PotentialEvaluator<TypeParam> evaluator(U, 3);
  // x = a - b, the gradient, and its sum into both bodies
  OperationCounts expected = U.terms[0].gradient.operations();
  expected.add(Op::subtract, 2 + 2);
  expected.add(Op::add, 2);
  EXPECT_EQ(evaluator.counts()[0].per_evaluation, expected);
}

/// Two attractions of the same pair have its distance in common. To displace the pair and to find its distance is the
/// first one's. What they add to the force, and in which order, is as it was. In double each is a kernel.
TYPED_TEST(PotentialTest, EffectsThatActAlikeShareWhatTheyHaveInCommon) {
  using S = TypeParam;
  const auto both = this->potential({this->attraction(), this->trap(), this->attraction(5), this->trap()});
  PotentialEvaluator<S> evaluator(both, 3);
  const Matrix<S> q = this->apart(3);
  Matrix<S> force, sum = Matrix<S>::Zero(3, 4);
  for (int call = 0; call < 2; ++call) evaluator.varying_force(lanes(q), force);
  for (const auto& term : both.terms) sum += this->varying_force(this->potential({term}), q);
  EXPECT_LE(max_norm(Matrix<S>(force - sum)), 8 * epsilon<S>() * max_norm(sum));
  const auto& counts = evaluator.counts();
  EXPECT_EQ(counts[2].evaluations, 6u);
  if (std::same_as<S, double>) {
    EXPECT_EQ(counts[2].done_before.total(), 0u);
    return;
  }
  OperationCounts done;
  done.add(Op::multiply, 3);
  done.add(Op::subtract, 2);
  done.add(Op::add, 2);
  EXPECT_EQ(counts[2].per_evaluation - counts[2].done_before, done);
  EXPECT_EQ(counts[2].per_evaluation, counts[0].per_evaluation);
  for (const std::size_t first : {0U, 1U}) EXPECT_EQ(counts[first].done_before.total(), 0u);
}

TYPED_TEST(PotentialTest, EveryLaneIsTreatedAlike) {
  const auto U = this->potential({this->gravity(), this->attraction(), this->trap()});
  const PotentialEvaluator<TypeParam> together(U, 5), alone(U, 1);
  const Matrix<TypeParam> q = this->apart(5);
  const Matrix<TypeParam> forces = this->varying_force(U, q);
  const Vector<TypeParam> values = this->values(U, q);
  EXPECT_EQ(together.constant_force(), alone.constant_force());
  for (Index i = 0; i < 5; ++i) {
    const Matrix<TypeParam> position = q.row(i);
    EXPECT_EQ(Matrix<TypeParam>(forces.row(i)), this->varying_force(U, position));
    EXPECT_EQ(values[i], this->values(U, position)[0]);
  }
}

TYPED_TEST(PotentialTest, TermsAddUp) {
  const auto sum = this->potential({this->attraction(), this->trap()}), first = this->potential({this->attraction()}),
             second = this->potential({this->trap()});
  const Matrix<TypeParam> q = this->apart(2);
  const Matrix<TypeParam> all = this->varying_force(sum, q);
  const Vector<TypeParam> U = this->values(sum, q);
  const TypeParam tolerance = 8 * epsilon<TypeParam>();
  EXPECT_LE(max_norm(Matrix<TypeParam>(all - this->varying_force(first, q) - this->varying_force(second, q))),
            tolerance * max_norm(all));
  EXPECT_LE(max_norm(Vector<TypeParam>(U - this->values(first, q) - this->values(second, q))), tolerance * max_norm(U));
}

TYPED_TEST(PotentialTest, EvaluationsOverwrite) {
  const auto U = this->potential({this->attraction()});
  PotentialEvaluator<TypeParam> evaluator(U, 2);
  const Matrix<TypeParam> q = this->apart(2);
  Matrix<TypeParam> fresh, used = this->random.matrix(2, 4);
  Vector<TypeParam> value, used_value = this->random.vector(2);
  evaluator.varying_force(lanes(q), fresh);
  evaluator.varying_force(lanes(q), used);
  evaluator.values(lanes(q), value);
  evaluator.values(lanes(q), used_value);
  EXPECT_EQ(fresh, used);
  EXPECT_EQ(value, used_value);
}

TYPED_TEST(PotentialTest, ActionAndReaction) {
  const auto U = this->potential({this->attraction()});
  const Matrix<TypeParam> force = this->varying_force(U, this->apart(3));
  EXPECT_EQ(Matrix<TypeParam>(force.leftCols(2)), Matrix<TypeParam>(-force.rightCols(2)));
  for (Index i = 0; i < 3; ++i) EXPECT_LT(force(i, 0), 0) << "the body on the right is pulled left";
}

TYPED_TEST(PotentialTest, NoTermsGiveZero) {
  const auto nothing = this->potential({});
  PotentialEvaluator<TypeParam> evaluator(nothing, 2);
  const Matrix<TypeParam> q = this->apart(2);
  Vector<TypeParam> U = this->random.vector(2);
  evaluator.values(lanes(q), U);
  EXPECT_EQ(U, (Vector<TypeParam>(Vector<TypeParam>::Zero(2))));
  EXPECT_EQ(evaluator.constant_force(), (Vector<TypeParam>(Vector<TypeParam>::Zero(4))));
  EXPECT_FALSE(evaluator.has_varying_force());
}

TYPED_TEST(PotentialTest, MeasuresTimeIfAsked) {
  const auto U = this->potential({this->attraction()});
  PotentialEvaluator<TypeParam> evaluator(U, 3);
  const Matrix<TypeParam> q = this->apart(3);
  Matrix<TypeParam> force;
  evaluator.varying_force(lanes(q), force);
  EXPECT_EQ(evaluator.counts()[0].seconds, 0);
  const MeasuredParts measured;
  for (int call = 0; call < 100; ++call) evaluator.varying_force(lanes(q), force);
  EXPECT_GT(evaluator.counts()[0].seconds, 0);
}

}  // namespace
}  // namespace hbvm::core
