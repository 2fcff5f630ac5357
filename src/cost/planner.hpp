#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cost/cost_errors.hpp"
#include "cost/cost_reference.hpp"
#include "scalar/precision.hpp"
#include "step/method.hpp"

namespace hbvm::core {

struct PlanRequest {
  Scene scene;
  Expression until;
  int digits = 0;
  CostQuantity quantity = CostQuantity::all;
  std::vector<MethodPtr> methods = {};
  std::vector<Precision> precisions = {};  ///< empty: double and quad where they do, and as many digits as it takes
  std::function<void(double)> progress = {};
};

/// A method, step and precision with what it costs: as the models have it, and as it was.
struct PlannedSetting {
  MethodPtr method;
  Precision precision;
  long steps = 0;
  std::string step = {};
  double operations = 0;                           ///< a step, in the working precision, as a short run counted them
  double nanoseconds = 0;                          ///< of the processor to one of them, with all that goes with it
  double predicted_seconds = 0;                    ///< steps x operations x nanoseconds
  double predicted_error = 0;                      ///< log10 of it
  std::optional<double> seconds = {}, error = {};  ///< measured over the whole time, if it was run
};

struct Plan {
  PlannedSetting pick;
  std::vector<PlannedSetting> runners_up;
  MotionNature nature;
  CostReference reference;
  int runs = 0;  ///< made to the end to find out
};

/// The cheapest setting for so many right digits. Each method is run once with few digits over the whole time. This
/// shows the reach of its steps and what the motion makes of errors, ErrorModel. A few of its steps in the precision it
/// would need show what a step costs. The cheapest by these models is run to the end; the models learn from it, and the
/// next is taken. This ends when nothing else is predicted to be cheaper than the best run that has the digits. Methods
/// that divide their steps have no step to be found: they are tried with one.
/// \throws InputError, IntegrationError if nothing has the digits
Plan plan_cost(const PlanRequest& request);

/// {"digits", "pick": {"method", "step", "precision"}, "predicted": {"seconds", "error"}, "measured": {"seconds",
/// "error"}, "runners_up": [...], ...}
std::string to_json(const PlanRequest& request, const Plan& plan, const std::string& command);

/// The same for people, with the command that makes the run.
std::string to_text(const PlanRequest& request, const Plan& plan);

}  // namespace hbvm::core
