#pragma once

#include <functional>
#include <vector>

#include "cost/cost_cell.hpp"
#include "cost/error_model.hpp"
#include "cost/planner.hpp"

namespace hbvm::core {

/// Whether it is HBVM(s,s), whose errors are those of its neighbours but for the order.
bool is_gauss(const Method& method);

/// A method with what is known of its errors.
struct PlannedMethod {
  MethodPtr method;
  ErrorModel model;
  bool learnt = false;  ///< from a run of its own
};

/// What steps leave how many digits right, by method: learnt from runs of few digits.
class MethodErrors {
 public:
  MethodErrors(const PlanRequest& request, const MotionNature& nature, const CostJudge& judge);

  /// A run of few digits for each method, but for those of many stages and those that divide their steps. A method
  /// without digits in a short time is left out.
  void learn(const std::function<void(double)>& progress);
  /// What was not run gets the reach of its nearest neighbour among HBVM(s,s).
  void share_reach();
  std::vector<PlannedMethod>& methods() { return methods_; }
  const ErrorModel& model(std::size_t method) const { return methods_[method].model; }

  /// How many steps are not longer than this; at least one.
  long steps_of(double log10_step) const;
  double log10_step(long steps) const;
  /// Whether so small steps are few enough to be made.
  bool has_steps(double log10_step) const;

  CostMeasurement run(const MethodPtr& method, const Precision& precision, long steps,
                      const CostRepetitions& repetitions) const;

 private:
  Precision pilot_precision(double digits) const;
  bool learn(PlannedMethod& planned);
  void learn_order(PlannedMethod& planned, const Precision& precision, long steps, double digits) const;

  const PlanRequest& request_;
  const MotionNature& nature_;
  const CostJudge& judge_;
  double until_ = 0;
  std::vector<PlannedMethod> methods_;
};

}  // namespace hbvm::core
