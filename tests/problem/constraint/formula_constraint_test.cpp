#include "problem/constraint/formula_constraint.hpp"

#include "printing.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/curvature.hpp"
#include "problem/effect/trace.hpp"
#include "problem/in_double.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Of one body, of a pair, of a group with a fixed point, and of points of rigid bodies, whose weights are not 1.
const char* const of_one = R"--(
dimension = 2
body = [
  { name = "a", mass = 2, position = [1, 2], velocity = [0, 0] },
  { name = "b", mass = 3, position = [-1, 1], velocity = [0, 0] },
]
point = [{ name = "O", position = ["1/3", "-1/5"] }]
constraint = [
  { kind = "formula", on = "a", g = "exp(x/3)*y^3 - cos(x*y)" },
  { kind = "formula", between = ["a", "b"], g = "r + sin(x) - x1*y2" },
  { kind = "formula", of = ["a", "b", "O"], g = "sqrt((a.x - O.x)^2 + (a.y - O.y)^2) + b.y^4/7" },
]
)--";
const char* const of_rigid = R"--(
dimension = 3
[[rigid_body]]
name = "bar"
mass = 2
center = [0, 0, 0]
second_moment = [[1, 0, 0], [0, 2, 0], [0, 0, "5/2"]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
position = [0, 0, 0]
velocity = [0, 0, 0]
angular_velocity = [0, 0, 0]

[[attachment]]
name = "tip"
of = "bar"
at = ["1/2", "-1/3", "2/7"]

[[constraint]]
kind = "formula"
on = "tip"
g = "atan(x*y) + z^3 - sinh(x)/3"
)--";

template <class S>
class FormulaConstraintTest : public InDigits<50> {
 protected:
  RandomValues<S> random{83};

  /// Calls check(problem, constraint number) for every constraint that is a formula.
  template <class Check>
  void each(Check check) {
    for (const char* const text : {of_one, of_rigid}) {
      const Assembled<S> scene = assemble<S>(read_scene(text, "test"), Consistency::unchecked);
      Index formulas = 0;
      for (Index a = 0; a < scene.problem.nu(); ++a) {
        if (!std::holds_alternative<FormulaConstraint<S>>(scene.problem.constraints[static_cast<std::size_t>(a)].form))
          continue;
        ++formulas;
        Vector<S> q = scene.q0;
        for (Index j = 0; j < q.size(); ++j) q[j] += random.value() / 8;
        check(scene.problem, scene.problem.constraints[static_cast<std::size_t>(a)], a, q);
      }
      EXPECT_EQ(formulas, text == of_one ? 3 : 1);
    }
  }
  /// A difference of sixth order, and how right it is.
  template <class F>
  S slope(F f) const {
    using std::pow;
    const S h = power_of_two<S>(-significand_bits<S>() / 7);
    const auto d = [&](int n) { return S((f(n * h) - f(-n * h)) / (2 * n * h)); };
    return (15 * d(1) - 6 * d(2) + d(3)) / 10;
  }
  S tolerance() const {
    using std::pow;
    return power_of_two<S>(-6 * (significand_bits<S>() / 7) + 14);
  }
};
TYPED_TEST_SUITE(FormulaConstraintTest, AllScalars, ScalarNames);

TYPED_TEST(FormulaConstraintTest, HasItsGradientInEveryLane) {
  using S = TypeParam;
  this->each([&](const Problem<S>& problem, const Constraint<S>& constraint, Index a, const Vector<S>& q) {
    constexpr Index lane_count = 3;
    ConstraintGradient<S> gradient(problem, lane_count);
    Matrix<S> at(lane_count, problem.m()), g(lane_count, problem.nu()), G = Matrix<S>::Zero(lane_count, problem.m());
    for (Index i = 0; i < lane_count; ++i)
      for (Index j = 0; j < problem.m(); ++j) at(i, j) = q[j] + S(static_cast<int>(i * j)) / 64;
    gradient.update(lanes(std::as_const(at)), g);
    Matrix<S> unit = Matrix<S>::Zero(lane_count, problem.nu());
    unit.col(a).setConstant(S(1));
    gradient.add_times(unit, lanes(G));
    for (Index i = 0; i < lane_count; ++i) {
      const Vector<S> here = at.row(i).transpose();
      EXPECT_EQ(g(i, a), value(constraint, problem.dimension, here).g);
      S sum = 0;
      for (Index j = 0; j < problem.m(); ++j) {
        const S expected = this->slope([&](const S& h) {
          Vector<S> moved = here;
          moved[j] += h;
          return value(constraint, problem.dimension, moved).g;
        });
        EXPECT_LE(magnitude(S(G(i, j) - expected)), this->tolerance()) << constraint.name << ' ' << j;
        sum += magnitude(G(i, j));
      }
      EXPECT_LE(sum, gradient_size(constraint, problem.dimension, here)) << constraint.name;
    }
  });
}

TYPED_TEST(FormulaConstraintTest, HasItsSecondDerivative) {
  using S = TypeParam;
  this->each([&](const Problem<S>& problem, const Constraint<S>& constraint, Index a, const Vector<S>& q) {
    const Vector<S> v = this->random.vector(problem.m());
    ConstraintGradient<S> gradient(problem, 1);
    const S expected = this->slope([&](const S& h) {
      const Vector<S> moved = q + h * v;
      gradient.update(lanes(moved));
      S along;
      gradient.transposed_times(a, lanes(v), &along);
      return along;
    });
    const S found = curvature(constraint, problem.dimension, q, v);
    EXPECT_LE(magnitude(S(found - expected)), this->tolerance()) << constraint.name;
    EXPECT_LE(magnitude(found), curvature_size(constraint, problem.dimension, q, v)) << constraint.name;
    // The same pair by pair, at the second of two nodes.
    Curvature<S> second(problem, 1, 2);
    for (const auto& entry : second.constraints()) EXPECT_NE(entry.constraint, a) << "of a rigid body's frame alone";
    Matrix<S> nodes(2, problem.m());
    nodes.row(0).setConstant(S(1));
    nodes.row(1) = q.transpose();
    const Matrix<S>& values = second.varying(lanes(std::as_const(nodes)));
    S sum = 0;
    for (std::size_t e = 0; e < second.varying_constraints().size(); ++e) {
      const auto& entry = second.varying_constraints()[e];
      const auto& pair = second.pairs()[static_cast<std::size_t>(entry.pair)];
      if (entry.constraint == a) sum += v[pair.row] * values(1, static_cast<Index>(e)) * v[pair.column];
    }
    EXPECT_LE(magnitude(S(sum - found)), 4096 * epsilon<S>() * curvature_size(constraint, problem.dimension, q, v));
  });
}

TYPED_TEST(FormulaConstraintTest, NamesItsCoordinatesAndRoundsToDouble) {
  using S = TypeParam;
  this->each([&](const Problem<S>& problem, const Constraint<S>& constraint, Index, const Vector<S>& q) {
    const auto named = coordinates(constraint, problem.dimension);
    EXPECT_TRUE(std::is_sorted(named.begin(), named.end()));
    for (Index j = 0; j < problem.m(); ++j) {
      if (std::binary_search(named.begin(), named.end(), j)) continue;
      Vector<S> moved = q;
      moved[j] += 1;
      EXPECT_EQ(value(constraint, problem.dimension, moved).g, value(constraint, problem.dimension, q).g);
    }
    const auto exact = value(constraint, problem.dimension, q);
    const Vector<double> near = q.unaryExpr([](const S& x) { return approximately(x); });
    const auto rounded = value(in_double(constraint), problem.dimension, near);
    EXPECT_NEAR(rounded.g, approximately(exact.g), 2 * epsilon<double>() * rounded.size) << constraint.name;
  });
}

/// A surface whose value and derivative nearly vanish at the start is fulfilled to the round-off of its terms.
TYPED_TEST(FormulaConstraintTest, IsFulfilledToTheRoundOffOfWhatItComputes) {
  using S = TypeParam;
  const std::string scene =
      "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [\"1/2^12\", \"1 - cos(1/2^12)\"], "
      "velocity = [0, 0] }]\nconstraint = [{ kind = \"formula\", on = \"a\", g = \"cos(x) - 1 + y\" }]\n";
  EXPECT_NO_THROW(assemble<S>(read_scene(scene, "test")));
  const Assembled<S> here = assemble<S>(read_scene(scene, "test"));
  const auto at = value(here.problem.constraints[0], 2, here.q0);
  EXPECT_GE(at.size, 1);
  EXPECT_LE(at.size, 8);
}

TYPED_TEST(FormulaConstraintTest, HasADegree) {
  using S = TypeParam;
  const auto degree_of = [](const char* name) { return degree(assemble<S>(load_scene(name)).problem.constraints); };
  EXPECT_EQ(degree_of("double_pendulum"), 2);
  EXPECT_EQ(degree_of("kepler"), 2);
  EXPECT_EQ(degree_of("bead_on_quartic"), 4);
  EXPECT_EQ(degree_of("bead_on_torus"), Trace<S>::not_polynomial);
  EXPECT_EQ(degree_of("bead_on_cycloid"), Trace<S>::not_polynomial) << "one of its two is quadratic";
}

}  // namespace
}  // namespace hbvm::core
