#include "cost/method_errors.hpp"

#include <gtest/gtest.h>

#include "cost/cost_methods.hpp"

namespace hbvm::core {
namespace {

TEST(MethodErrors, PredictWhatARunThenLeaves) {
  PlanRequest request{load_scene("double_pendulum"), Expression::parse("10"), 12};
  request.methods = cost_methods({"hbvm:2,2", "hbvm:6,6", "hbvm:16,16", "rattle"}, 12);
  const MotionNature nature = find_nature(request.scene, request.until, nullptr, {});
  const CostReference reference = find_cost_reference({.scene = &request.scene, .until = request.until, .digits = 50});
  const CostJudge judge(request.scene, reference.state, reference.digits);
  MethodErrors errors(request, nature, judge);
  errors.learn([](double) {});
  ASSERT_EQ(errors.methods().size(), 4u);
  for (const PlannedMethod& planned : errors.methods()) {
    // One of many stages is believed to be like its neighbours, and never run to learn from.
    EXPECT_EQ(planned.learnt, planned.method->stages() < 16) << planned.method->text();
    const bool is_rattle = planned.method->text() == "rattle";
    const double digits = is_rattle ? 5 : 9;
    const long steps = errors.steps_of(planned.model.log10_step(digits));
    const CostMeasurement m = errors.run(planned.method, Precision::parse("double"), steps, {1, 1, 0, false});
    ASSERT_EQ(m.failure, "") << planned.method->text();
    EXPECT_NEAR(-m.errors.of(request.quantity), digits, planned.learnt ? 1 : 3) << planned.method->text();
  }
}

TEST(MethodErrors, LeaveOutWhatHasNoDigitsInTime) {
  PlanRequest request{load_scene("kepler"), Expression::parse("10"), 5};
  request.methods = cost_methods({"rattle"}, 5);
  const CostReference reference = find_cost_reference({.scene = &request.scene, .until = request.until, .digits = 50});
  const CostJudge judge(request.scene, reference.state, reference.digits);
  // As if steps had to be a billion times smaller.
  const MotionNature wild{0, -60};
  MethodErrors errors(request, wild, judge);
  errors.learn([](double) {});
  EXPECT_LE(errors.methods().size(), 1u);
  EXPECT_FALSE(errors.has_steps(-9));
  EXPECT_TRUE(errors.has_steps(-7));
}

}  // namespace
}  // namespace hbvm::core
