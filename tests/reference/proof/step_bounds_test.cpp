#include "reference/proof/step_bounds.hpp"

#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

struct BoundsOf {
  explicit BoundsOf(const char* name)
      : scene(load_scene(name)),
        bounds(scene.exact, [] {}),
        motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0),
        step(step_of(motion, bounds.problem())) {}

  ProvedScene scene;
  StepBounds bounds;
  TaylorMotion motion;
  SeriesStep step;
};

TEST(StepBounds, OfAStepHoldAClosedForm) {
  const PrecisionScope digits(40);
  BoundsOf of("simple_pendulum");
  const BallScope few(64);
  const ErrorDistance before{rounded_up(of.bounds.distance_of_start(of.step, 1)), 1}, tube{power_of_two_of(-100), 1};
  RealBall half = of.step.end() / RealBall(2);
  arb_get_mid_arb(raw(half), raw(half));
  const StepCourse course = of.bounds.course(of.step, of.bounds.defect(of.step), tube, {{half, 1}, {of.step.end(), 1}});
  ASSERT_EQ(course.pieces.size(), 2u);
  EXPECT_TRUE(course.stays_in_tube(before));
  EXPECT_GT(course.growth, 0);
  const ProvedState state = of.bounds.state(of.step, half, course.distance_at(half, before));
  Mpfr t;
  arf_get_mpfr(raw(t), arb_midref(raw(half * of.step.unit())), MPFR_RNDN);
  const ExactPoint exact = known_motion("simple_pendulum", t);
  const RealBall rounding = power_of_two_of(-120);
  for (Index j = 0; j < 2; ++j) {
    EXPECT_TRUE(holds(widened(state.q[static_cast<std::size_t>(j)], rounding), exact.q[j]));
    EXPECT_TRUE(holds(widened(state.p[static_cast<std::size_t>(j)], rounding), exact.p[j]));
  }
  EXPECT_LT(radius_of(state.q[0]), 1e-32);
}

/// Rates are greater in a wider tube, and where it is as wide as the pendulum is long there are none.
TEST(StepBounds, OfAWideTubeAreWide) {
  const PrecisionScope digits(30);
  BoundsOf of("simple_pendulum");
  const BallScope few(64);
  const Defect defect = of.bounds.defect(of.step);
  const auto growth = [&](double radius) {
    return of.bounds.course(of.step, defect, {exact_ball(radius), 1}, {{of.step.end(), 1}}).growth;
  };
  EXPECT_LT(growth(1e-6), growth(1e-2));
  EXPECT_THROW(growth(1), IntegrationError);
}

TEST(StepBounds, SeeWhatStepsDifferBy) {
  const PrecisionScope digits(30);
  BoundsOf of("double_pendulum");
  EXPECT_LT(centre_of(raw(of.bounds.distance_of_start(of.step, 1))), 1e-28);
  EXPECT_GT(centre_of(raw(of.bounds.jump(of.step, of.step, 1))), 0.01);
  of.motion.next_step();
  const SeriesStep next = step_of(of.motion, of.bounds.problem());
  EXPECT_LT(centre_of(raw(of.bounds.jump(of.step, next, 1))), 1e-28);
}

TEST(RoundedUp, IsAShortNumberAndLittleMore) {
  const BallScope bits(200);
  const RealBall third = RealBall(1) / RealBall(3), up = rounded_up(third);
  EXPECT_TRUE(third.is_below(up));
  EXPECT_TRUE(up.is_below(third * exact_ball(1.0001)));
  EXPECT_LE(arb_bits(raw(up)), 24);
  EXPECT_NE(arb_is_zero(raw(rounded_up(RealBall(0)))), 0);
}

}  // namespace
}  // namespace hbvm::core
