#include <gtest/gtest.h>

#include "audit/claim_groups.hpp"
#include "audit/measurements.hpp"
#include "reference/known_motion.hpp"
#include "reference/reference_motion.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

Ladders step_errors(const ClaimGroup& group, std::size_t rungs) {
  return step_ladder<Quad>(group, [&](const Ladders& ladders) { return ladders.begin()->second.size() == rungs; });
}

/// One step is of one order more than a run.
TEST(StepLadder, HasTheRateOfOneStep) {
  const Ladders ladders = step_errors(group_of("kepler", {2, 2}, {Quantity::q}, Span::step), 9);
  EXPECT_TRUE(is_rate(ladders.at(Quantity::q), 5));
  EXPECT_TRUE(is_rate(ladders.at(Quantity::p), 5));
  EXPECT_TRUE(is_rate(ladders.at(Quantity::H), 5));
}

TEST(StepLadder, StepsArePartsOfTheScaleAndItsErrorsThoseOfTheStep) {
  ClaimGroup group = group_of("simple_pendulum", {2, 2}, {Quantity::q}, Span::step);
  group.log2_scale = -1;
  group.starts.lead = 0;
  const auto rungs = step_errors(group, 3).at(Quantity::q);
  const PrecisionScope digits(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(2, 2);
  for (int i = 0; i < 3; ++i) {
    const Rung& rung = rungs[static_cast<std::size_t>(i)];
    EXPECT_EQ(rung.step, -3 - i);
    EXPECT_TRUE(rung.is_clean());
    HbvmStepper<Mpfr> stepper(scene.problem, method, SolverKind::fixed_point);
    State<Mpfr> state(scene.q0, scene.p0);
    const Mpfr h = ldexp(Mpfr(1), -3 - i);
    stepper.step(state, h);
    const Vector<Mpfr> exact = known_motion("simple_pendulum", h).q;
    EXPECT_NEAR(rung.error, log2_of(max_norm(Vector<Mpfr>(state.q - exact))), 1 / double{1000});
  }
}

}  // namespace
}  // namespace hbvm::core
