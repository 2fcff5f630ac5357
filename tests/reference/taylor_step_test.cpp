#include "reference/taylor_step.hpp"

#include "printing.hpp"
#include "reference/proof/holds.hpp"

namespace hbvm::core {
namespace {

/// The polynomials have the coefficients of the series, without rounding, and end where the step does.
TEST(TaylorStep, HasTheCoefficientsOfTheSeries) {
  const PrecisionScope digits(30);
  const ProvedScene scene(load_scene("double_pendulum"));
  const BallProblem balls = scene.balls();
  const BallScope bits(300);
  TaylorMotion motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0);
  motion.next_step();
  const SeriesStep step = step_of(motion, balls);
  for (const Index n : {Index(0), Index(1), step.order(), step.order() + 1}) {
    EXPECT_TRUE(holds(step.q()[3][n], motion.position(3)[n])) << n;
    EXPECT_EQ(radius_of(step.q()[3][n]), 0) << n;
  }
  EXPECT_EQ(step.q()[3].length(), step.order() + 2);
  EXPECT_EQ(step.lambda()[1].length(), step.order());
  EXPECT_TRUE(holds(step.lambda()[1][2], motion.multiplier(1)[2]));
  EXPECT_TRUE(holds(step.end() * step.unit(), motion.length()));
}

/// A step may be ended sooner, and the next begins there.
TEST(TaylorStep, EndsWhereTheMotionIsShortened) {
  const PrecisionScope digits(30);
  const ProvedScene scene(load_scene("double_pendulum"));
  TaylorMotion motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0);
  const Mpfr half = motion.length() / 2;
  motion.shorten(half);
  motion.shorten(10 * half);
  EXPECT_EQ(motion.length(), half);
  motion.next_step();
  EXPECT_EQ(motion.start(), half);
}

}  // namespace
}  // namespace hbvm::core
