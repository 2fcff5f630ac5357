#include "reference/proof/series_step.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/known_motion.hpp"
#include "reference/proof/holds.hpp"

namespace hbvm::core {
namespace {

/// The polynomials of a step are where the motion is, moves as it does, and are pulled by its multiplier.
TEST(SeriesStep, IsTheMotionOfOneStep) {
  const PrecisionScope digits(40);
  for (const char* name : {"simple_pendulum", "bead_on_helix"}) {
    const ProvedScene scene(load_scene(name));
    const BallProblem balls = scene.balls();
    const BallScope bits(160);
    const TaylorMotion motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0);
    const SeriesStep step = step_of(motion, balls);
    EXPECT_EQ(step.order(), motion.order() - 1);
    const RealBall s = step.end() / RealBall(3), error = power_of_two_of(-110), t = s * step.unit();
    Mpfr time;
    arf_get_mpfr(raw(time), arb_midref(raw(t)), MPFR_RNDN);
    const ExactPoint exact = known_motion(name, time);
    const std::vector<RealBall> q = step.positions(s), p = balls.momentum(step.velocities(s));
    for (Index j = 0; j < exact.q.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      EXPECT_TRUE(holds(widened(q[i], error), exact.q[j])) << name << " " << j;
      EXPECT_TRUE(holds(widened(p[i], error), exact.p[j])) << name << " " << j;
    }
    for (Index a = 0; a < exact.lambda.size(); ++a)
      EXPECT_TRUE(holds(widened(step.lambda()[static_cast<std::size_t>(a)].at(s), error), exact.lambda[a])) << name;
    // Rounded, it still holds what it was.
    const BallScope few(60);
    const std::vector<RealBall> rounded = step.rounded().positions(s);
    EXPECT_TRUE(holds(widened(rounded[0], error), exact.q[0]));
    EXPECT_GT(radius_of(rounded[0]), 1e-20);
  }
}

/// The acceleration of a body on which nothing acts is 0; the pendulum's is that of its forces.
TEST(SeriesStep, HasTheAccelerationOfTheForces) {
  const PrecisionScope digits(40);
  const ProvedScene scene(load_scene("simple_pendulum"));
  const BallProblem balls = scene.balls();
  const BallScope bits(160);
  const TaylorMotion motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0);
  const SeriesStep step = step_of(motion, balls);
  StateEvaluator<Mpfr> point(scene.rounded.problem);
  const auto& forces = point.forces(scene.rounded.q0, scene.rounded.p0);
  const std::vector<RealBall> a = step.accelerations(RealBall());
  for (Index j = 0; j < 2; ++j)
    EXPECT_TRUE(holds(widened(a[static_cast<std::size_t>(j)], power_of_two_of(-110)),
                      Mpfr(forces.applied[j] + forces.constraint[j])));
}

}  // namespace
}  // namespace hbvm::core
