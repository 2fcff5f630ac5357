#include "reference/proof/ball_effect.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

Scene scene_of_formula(const std::string& U) {
  return read_scene(
      "dimension = 2\n[constants]\nc = \"7/10\"\n" + body("a", "1", "[\"3/5\", \"4/7\"]", "[0, 0]") + formula(U),
      "formula");
}

/// Each function that a formula may have, along a straight line: its series of balls, summed up, is the gradient there.
TEST(BallEffect, HasTheSeriesOfEachFunction) {
  const PrecisionScope digits(50);
  for (const char* U :
       {"x^3*y + c*x", "1/(x + c*y)", "sqrt(x + 2*y)", "exp(x*y)", "log(x + y)", "sin(x*y)", "cos(x - c*y)",
        "sinh(x*y)", "cosh(x*y)", "tanh(x + y)", "atan(x*y)", "abs(x - 2)*y", "x^(3/2)"}) {
    const ProvedScene scene(scene_of_formula(U));
    const BallProblem balls = scene.balls();
    const BallScope bits(200);
    const Mpfr s = Mpfr(1) / 256;
    const Vector<Mpfr> slope{{Mpfr(1) / 3, Mpfr(-1) / 2}};
    std::vector<BallSeries> q;
    Vector<Mpfr> at = scene.rounded.q0;
    for (Index j = 0; j < 2; ++j) {
      const Mpfr coefficients[] = {at[j], slope[j]};
      q.push_back(BallSeries::exactly(coefficients, 2));
      at[j] += s * slope[j];
    }
    constexpr Index terms = 24;
    const std::vector<BallSeries> force = balls.force(q, terms);
    StateEvaluator<Mpfr> point(scene.rounded.problem);
    const Vector<Mpfr> none = Vector<Mpfr>::Zero(2), expected = point.forces(at, none).applied;
    RealBall time, tail;
    arf_set_mpfr(arb_midref(raw(time)), raw(s));
    arb_set_str(raw(tail), "1e-45", 64);
    for (Index j = 0; j < 2; ++j) {
      const RealBall sum = force[static_cast<std::size_t>(j)].at(time);
      EXPECT_TRUE(holds(widened(sum, tail), expected[j])) << U << ": " << text_of(sum) << " and " << expected[j];
      EXPECT_LT(radius_of(sum), 1e-40) << U;
    }
  }
}

/// Where an operation may have no value, nothing is said.
TEST(BallEffect, IsNotFiniteWhereAnOperationHasNoValue) {
  const PrecisionScope digits(30);
  for (const char* U : {"1/(x - 3/5)", "sqrt(x - 3/5)*y", "log(x - 3/5)", "abs(x - 3/5)*y"}) {
    const Scene scene = read_scene("dimension = 2\n" + body("a", "1", "[1, 1]", "[0, 0]") + formula(U), "formula");
    const ProvedScene proved(scene);
    const BallProblem balls = proved.balls();
    RealBall wide;
    arb_set_d(raw(wide), 0.7);
    mag_set_d(arb_radref(raw(wide)), 0.2);
    const std::vector<BallSeries> force = balls.force(as_series({wide, RealBall(1)}), 1);
    EXPECT_FALSE(force[0][0].is_finite() && force[1][0].is_finite()) << U;
  }
}

/// A number that is rounded is somewhere near it; of what is 0 that is known.
TEST(BallEffect, BelievesThreeQuartersOfTheDigits) {
  const PrecisionScope digits(40);
  const RealBall third = believed(Mpfr(Mpfr(1) / 3));
  EXPECT_GT(radius_of(third), 1e-33);
  EXPECT_LT(radius_of(third), 1e-29);
  EXPECT_EQ(radius_of(believed(Mpfr(0))), 0);
}

}  // namespace
}  // namespace hbvm::core
