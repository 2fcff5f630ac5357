#include "cost/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cost/cost_cell.hpp"
#include "cost/cost_methods.hpp"
#include "reference/taylor_method.hpp"

namespace hbvm::core {
namespace {

PlanRequest request_of(const char* scene, int digits) {
  PlanRequest request{load_scene(scene), Expression::parse("10"), digits};
  request.methods = cost_methods({"gauss", "rattle"}, digits, Choice::dense);
  return request;
}

TEST(Planner, ReachesTheDigitsItWasAskedFor) {
  for (const char* const scene : {"kepler", "double_pendulum"})
    for (const int digits : {5, 12, 25}) {
      const PlanRequest request = request_of(scene, digits);
      const Plan plan = plan_cost(request);
      ASSERT_TRUE(plan.pick.error) << scene;
      EXPECT_LE(*plan.pick.error, -digits) << scene;
      EXPECT_GT(*plan.pick.seconds, 0) << scene;
      // It is no accident that has many more.
      EXPECT_GE(*plan.pick.error, -2 * digits - 6) << scene;
      // What it says is what such a run gives.
      const CostJudge judge(request.scene, plan.reference.state, plan.reference.digits);
      const CostMeasurement again = measure_cost(
          request.scene, request.until, {plan.pick.method, plan.pick.precision, plan.pick.steps}, judge, {1, 1, 0});
      EXPECT_EQ(again.errors.of(request.quantity), *plan.pick.error) << scene;
      for (const PlannedSetting& other : plan.runners_up)
        if (other.seconds) {
          EXPECT_GE(*other.seconds, *plan.pick.seconds) << scene;
        }
    }
}

TEST(Planner, TakesHighOrderForManyDigits) {
  const Plan few = plan_cost(request_of("double_pendulum", 3)), many = plan_cost(request_of("double_pendulum", 40));
  EXPECT_GT(many.pick.method->order(), few.pick.method->order());
  EXPECT_GE(many.pick.method->order(), 20);
  EXPECT_GE(many.pick.precision.digits(), 40u);
  EXPECT_EQ(few.pick.precision.name(), "double");
}

TEST(Planner, TriesWhatDividesItsStepsWithOne) {
  add_taylor_method();
  PlanRequest request = request_of("kepler", 8);
  request.methods = cost_methods({"bulirsch_stoer"}, 8, Choice::dense);
  EXPECT_LE(*plan_cost(request).pick.error, -8);
  request = request_of("kepler", 40);
  request.methods = cost_methods({"taylor"}, 40, Choice::dense);
  const Plan many = plan_cost(request);
  EXPECT_EQ(many.pick.method->text(), "taylor");
  EXPECT_EQ(many.pick.steps, 1);
  // What cannot be run is no runner-up.
  request.methods = cost_methods({"taylor", "hbvm:8,8"}, 8, Choice::dense);
  request.digits = 8;
  for (const PlannedSetting& other : plan_cost(request).runners_up) EXPECT_GT(other.predicted_seconds, 0);
  EXPECT_LE(*many.pick.error, -40);
}

TEST(Planner, SaysWhenNothingHasTheDigits) {
  PlanRequest request = request_of("double_pendulum", 30);
  request.precisions = {Precision::parse("double")};
  request.methods = cost_methods({"hbvm:8,8"}, 30);
  EXPECT_THROW(plan_cost(request), IntegrationError);
}

TEST(Planner, RefusesWhatCannotBeAsked) {
  EXPECT_THROW(plan_cost(request_of("kepler", 0)), InputError);
  PlanRequest request = request_of("kepler", 5);
  request.quantity = CostQuantity::lambda;
  EXPECT_THROW(plan_cost(request), InputError);
}

}  // namespace
}  // namespace hbvm::core
