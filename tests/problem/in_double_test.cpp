#include "problem/in_double.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/effect/input.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ProblemInDouble : public InDigits<50> {
 protected:
  RandomValues<double> random{89};

  /// All forms of constraints and blocks of masses, a field that is weaker where it is oblate, and a spring.
  static Problem<S> problem(Index d) {
    Problem<S> result = constrained_problem<S>(d);
    for (Index body = 0; body < 4; ++body) result.blocks.push_back({body * d, body != 2});
    typename EffectInput<S>::Instance body, pair;
    body.x = {{{0, S(1)}}, Vector<S>::Constant(d, literal<S>("2.1"))};
    pair.x = {{{d, S(1)}, {3 * d, S(-1)}}, {}};
    body.mass_matrix = pair.mass_matrix = Matrix<S>::Identity(d, d);
    body.masses[0] = S(1);
    std::vector<S> axis(static_cast<std::size_t>(d), literal<S>("0.3"));
    result.potential.terms = {
        make_term<S>({"oblateness",
                      d,
                      {{"strength", literal<S>("1.2")}, {"radius", literal<S>("0.7")}, {"J2", literal<S>("0.6")}},
                      {{"axis", axis}},
                      {body}}),
        make_term<S>({"spring",
                      d,
                      {{"stiffness", literal<S>("1.3")}, {"rest_length", literal<S>("0.4")}, {"exponent", S(2)}},
                      {},
                      {pair}})};
    return result;
  }
};
TYPED_TEST_SUITE(ProblemInDouble, AllScalars, ScalarNames);

TYPED_TEST(ProblemInDouble, SaysTheSameOfAState) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = this->problem(d);
    const Problem<double> rounded = in_double(problem);
    ASSERT_EQ(rounded.m(), problem.m());
    EXPECT_EQ(rounded.dimension, d);
    EXPECT_EQ(rounded.potential.dimension, d);
    EXPECT_EQ(rounded.potential.m, problem.m());
    ASSERT_EQ(rounded.blocks.size(), problem.blocks.size());
    for (std::size_t b = 0; b < rounded.blocks.size(); ++b) {
      EXPECT_EQ(rounded.blocks[b].offset, problem.blocks[b].offset);
      EXPECT_EQ(rounded.blocks[b].translates, problem.blocks[b].translates);
    }
    const Vector<double> q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
    const Vector<S> exact_q = q.template cast<S>(), exact_p = p.template cast<S>();
    StateEvaluator<S> exact(problem);
    StateEvaluator<double> point(rounded);
    const double bound = 256 * epsilon<double>();
    EXPECT_NEAR(point.energy(q, p), approximately(exact.energy(exact_q, exact_p)), bound * point.energy_size(q, p));
    const auto near = [&](const Vector<double>& a, const Vector<S>& b) {
      ASSERT_EQ(a.size(), b.size());
      for (Index i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], approximately(b[i]), 16 * bound) << i;
    };
    near(point.constraints(q), exact.constraints(exact_q));
    near(point.hidden_constraints(q, p), exact.hidden_constraints(exact_q, exact_p));
    near(point.forces(q, p).applied, exact.forces(exact_q, exact_p).applied);
    for (Index a = 0; a < rounded.nu(); ++a)
      EXPECT_EQ(rounded.constraints[static_cast<std::size_t>(a)].name,
                problem.constraints[static_cast<std::size_t>(a)].name);
  }
}

/// The true axis is within what is said of its rounding.
TYPED_TEST(ProblemInDouble, BoundsTheRoundOffOfAnAxis) {
  using S = TypeParam;
  const Problem<S> problem = this->problem(3);
  const EffectSymmetry<S>& exact = problem.potential.terms[0].symmetry;
  const EffectSymmetry<double> rounded = in_double(problem).potential.terms[0].symmetry;
  EXPECT_EQ(rounded.kind, Symmetry::axial);
  EXPECT_EQ(rounded.acts, exact.acts);
  ASSERT_EQ(rounded.axes.size(), 3);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_LE(magnitude(S(exact.axes.data()[i] - S(rounded.axes.data()[i]))), S(rounded.axis_round_off.data()[i]));
    EXPECT_LT(rounded.axis_round_off.data()[i], 8 * epsilon<double>());
    EXPECT_GT(rounded.axis_round_off.data()[i], 0);
  }
}

TYPED_TEST(ProblemInDouble, FitsIfProductsOfTwoDo) {
  using S = TypeParam;
  for (const S& fits : {S(0), S(1), S(-1), power_of_two<S>(498), power_of_two<S>(-500), S(-power_of_two<S>(498))})
    EXPECT_TRUE(fits_double(fits)) << fits;
  for (const S& does_not : {power_of_two<S>(499), power_of_two<S>(-501), S(-power_of_two<S>(499))})
    EXPECT_FALSE(fits_double(does_not)) << does_not;
}

TYPED_TEST(ProblemInDouble, FitsIfItsMassesDo) {
  using S = TypeParam;
  for (const S& mass : {power_of_two<S>(600), power_of_two<S>(-600)}) {
    Problem<S> scalar = this->problem(2), full = this->problem(2);
    EXPECT_TRUE(fits_double(scalar));
    scalar.mass.add_scalar(2, mass);
    EXPECT_FALSE(fits_double(scalar)) << mass;
    full.mass.add_full(Matrix<S>(mass * mass_block<S>(2)));
    EXPECT_FALSE(fits_double(full)) << mass;
  }
}

}  // namespace
}  // namespace hbvm::core
