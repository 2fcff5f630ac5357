#include <fmt/format.h>

#include "cost/cost_methods.hpp"
#include "cost/planner.hpp"
#include "door/door.hpp"
#include "hbvm/cost.hpp"
#include "scene/set_number.hpp"

namespace hbvm {
namespace {

PlannedRun planned(const core::PlannedSetting& setting) {
  return {.method = setting.method->text(),
          .step = setting.step,
          .precision = setting.precision.name(),
          .steps = setting.steps,
          .predicted_seconds = setting.predicted_seconds,
          .predicted_error = setting.predicted_error,
          .seconds = setting.seconds,
          .error = setting.error};
}

}  // namespace

Plan plan(const PlanRequest& door) {
  const core::Admitted admitted(door.stop);
  core::PlanRequest request{core::scene_of(door.scene), core::expression_of(door.until, "until"), door.digits,
                            core::parse_cost_quantity(door.quantity)};
  request.methods = core::cost_methods(door.methods, door.digits, core::Choice::dense);
  for (const std::string& name : door.precisions) request.precisions.push_back(core::Precision::parse(name));
  request.progress = core::watched(door.progress);
  const core::Plan found = core::plan_cost(request);
  Plan plan{.pick = planned(found.pick), .runners_up = {}, .runs = found.runs, .text = {}, .json = {}};
  for (const core::PlannedSetting& setting : found.runners_up) plan.runners_up.push_back(planned(setting));
  plan.text = core::to_text(request, found);
  plan.json = core::to_json(
      request, found,
      fmt::format("hbvm cost {} --until '{}' --digits {}",
                  request.scene.name + core::settings_in_command(request.scene), door.until.text(), door.digits));
  return plan;
}

std::string to_json(const Plan& plan) { return plan.json; }

}  // namespace hbvm
