#include "problem/curvature.hpp"

#include <set>

#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/effect/input.hpp"

namespace hbvm::core {
namespace {

template <class S>
class CurvatureTest : public InDigits<50> {
 protected:
  RandomValues<S> random{83};

  /// Constraints of every form, with a stiff spring between two bodies, the attraction of a centre, and a uniform
  /// field.
  static Problem<S> problem(Index d) {
    Problem<S> result = constrained_problem<S>(d);
    using Instance = typename EffectInput<S>::Instance;
    Instance pair, body, other;
    pair.x = {{{d, S(1)}, {2 * d, S(-1)}}, {}};
    body.x = {{{0, S(1)}}, Vector<S>::Constant(d, S(3))};
    other.x = {{{3 * d, S(1)}}, Vector<S>::Constant(d, S(-2))};
    for (Instance* x : {&pair, &body, &other}) {
      x->mass_matrix = Matrix<S>::Identity(d, d);
      x->masses[0] = x->masses[1] = 1;
    }
    result.potential.terms = {
        make_term<S>({"spring", d, {{"stiffness", S(3)}, {"rest_length", S(1)}, {"exponent", S(4)}}, {}, {pair}}),
        make_term<S>({"central_gravity", d, {{"strength", S(2)}}, {}, {body, other}}),
        make_term<S>({"uniform_gravity", d, {}, {{"acceleration", std::vector<S>(d, S(1))}}, {body}})};
    return result;
  }
};
TYPED_TEST_SUITE(CurvatureTest, AllScalars, ScalarNames);

TYPED_TEST(CurvatureTest, NamesEachPairOnceAndBothOrders) {
  const Problem<TypeParam> problem = this->problem(3);
  const Curvature<TypeParam> curvature(problem, 2, 2);
  std::set<std::pair<Index, Index>> seen;
  for (const auto& pair : curvature.pairs()) EXPECT_TRUE(seen.emplace(pair.row, pair.column).second);
  for (const auto& [row, column] : seen) EXPECT_TRUE(seen.contains({column, row})) << row << ", " << column;
}

TYPED_TEST(CurvatureTest, OfConstraintsIsTheSecondDifference) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = this->problem(d);
    const Curvature<S> curvature(problem, 1, 1);
    const Vector<S> q = this->random.vector(problem.m()), v = this->random.vector(problem.m());
    Vector<S> sums = Vector<S>::Zero(problem.nu());
    for (const auto& entry : curvature.constraints()) {
      const auto& pair = curvature.pairs()[static_cast<std::size_t>(entry.pair)];
      sums[entry.constraint] += entry.value * v[pair.row] * v[pair.column];
    }
    EXPECT_LE(max_norm(Vector<S>(sums - dense_curvature(problem, q, v))), 512 * epsilon<S>()) << d;
  }
}

TYPED_TEST(CurvatureTest, OfThePotentialIsTheDifferenceOfForces) {
  using S = TypeParam;
  using std::cbrt;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = this->problem(d);
    const Index nodes = 2, m = problem.m();
    const Matrix<S> q = this->random.matrix(nodes, m);
    Curvature<S> curvature(problem, nodes, 1);
    curvature.potential(lanes(q));  // what it was called for before does not shine through
    const Matrix<S>& values = curvature.potential(lanes(q));
    PotentialEvaluator<S> evaluator(problem.potential, nodes);
    const S step = cbrt(epsilon<S>());
    for (Index column = 0; column < m; ++column) {
      Matrix<S> before = q, after = q, lower, higher;
      before.col(column).array() -= step;
      after.col(column).array() += step;
      evaluator.force(lanes(std::as_const(before)), lower);
      evaluator.force(lanes(std::as_const(after)), higher);
      Matrix<S> difference = (higher - lower) / (2 * step);
      for (std::size_t k = 0; k < curvature.pairs().size(); ++k)
        if (curvature.pairs()[k].column == column)
          difference.col(curvature.pairs()[k].row) -= values.col(static_cast<Index>(k));
      EXPECT_LE(max_norm(difference), 4000 * step * step) << "d = " << d << ", column " << column;
    }
  }
}

}  // namespace
}  // namespace hbvm::core
