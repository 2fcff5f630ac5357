#include "method_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cost/cost_grid.hpp"
#include "cost/cost_methods.hpp"
#include "scalar/literal.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

/// Methods of this many stages show in double what more stages do.
constexpr int most_piloted_stages = 12;
/// A run to learn from takes no longer.
constexpr double pilot_seconds = double{3} / 10;
/// More steps than that are never the cheapest way to anything.
constexpr double most_planned_steps = 1'000'000'000;

}  // namespace

bool is_gauss(const Method& method) {
  const HbvmMethod* const hbvm = as_hbvm(method);
  return hbvm && hbvm->name().k == hbvm->name().s;
}

MethodErrors::MethodErrors(const PlanRequest& request, const MotionNature& nature, const CostJudge& judge)
    : request_(request), nature_(nature), judge_(judge) {
  const PrecisionScope scope(Precision::min_digits);
  until_ = approximately(evaluate<Mpfr>(request.until, request.scene.constants));
}

long MethodErrors::steps_of(double log10_step) const {
  return std::max(1L, static_cast<long>(std::ceil(until_ / std::pow(10, log10_step))));
}

double MethodErrors::log10_step(long steps) const { return std::log10(until_ / static_cast<double>(steps)); }

bool MethodErrors::has_steps(double log10_step) const { return until_ / std::pow(10, log10_step) < most_planned_steps; }

CostMeasurement MethodErrors::run(const MethodPtr& method, const Precision& precision, long steps,
                                  const CostRepetitions& repetitions) const {
  return measure_cost(request_.scene, request_.until, {method, precision, steps}, judge_, repetitions);
}

/// Where errors of few digits are not lost in the motion's growth of rounding.
Precision MethodErrors::pilot_precision(double digits) const {
  for (const char* const name : {"double", precision_of_34_digits()})
    if (reachable_digits(Precision::parse(name), nature_) >= digits) return Precision::parse(name);
  return Precision::parse("mpfr:" + std::to_string(static_cast<int>(std::ceil(digits + nature_.digits_lost)) + 4));
}

void MethodErrors::learn(const std::function<void(double)>& progress) {
  double part = 0;
  for (const MethodPtr& method : request_.methods) {
    progress(part++ / static_cast<double>(request_.methods.size()));
    const double order = method->order();
    const ErrorModel guess{order > 0 ? order : 4,
                           std::log10(typical_reach(*method)) + nature_.log2_radius * std::log10(double{2}),
                           nature_.digits_lost};
    PlannedMethod planned{method, guess};
    const bool guessed = method->digits() || (is_gauss(*method) && method->stages() > most_piloted_stages);
    if (guessed || learn(planned)) methods_.push_back(planned);
  }
  share_reach();
}

bool MethodErrors::learn(PlannedMethod& planned) {
  constexpr double least_aim = 4, most_aim = 11;
  const double aim = std::clamp(planned.model.order / 2, least_aim, most_aim);
  const Precision precision = pilot_precision(aim + 1);
  long steps = steps_of(planned.model.log10_step(aim));
  const auto sample = [&] {
    return sample_cost(request_.scene, request_.until, {planned.method, precision, steps}, 4, pilot_seconds / 8);
  };
  constexpr int attempts = 6;
  constexpr double least = 1;  // right digits that tell of an order
  for (int n = 0; n < attempts; ++n) {
    if (static_cast<double>(steps) > most_planned_steps) return false;
    const CostSample cost = sample();
    const bool too_dear = cost.failure.empty() && cost.seconds * static_cast<double>(steps) > pilot_seconds;
    if (too_dear && n == 0) {
      steps = std::max(1L, static_cast<long>(pilot_seconds / cost.seconds));
    } else if (too_dear) {
      return false;
    }
    if (cost.failure.empty()) {
      const CostMeasurement m = run(planned.method, precision, steps, {1, 1, 0, false});
      const double digits = -m.errors.of(request_.quantity);
      if (m.failure.empty() && digits >= least) {
        learn_order(planned, precision, steps, digits);
        planned.model = planned.model.corrected(log10_step(steps), digits);
        planned.learnt = true;
        return true;
      }
    }
    steps *= 2;
  }
  return false;
}

/// Of a method that does not say its order: from half of the steps.
void MethodErrors::learn_order(PlannedMethod& planned, const Precision& precision, long steps, double digits) const {
  if (planned.method->order() > 0 || steps < 2) return;
  const long half = steps / 2;
  const CostMeasurement m = run(planned.method, precision, half, {1, 1, 0, false});
  if (!m.failure.empty()) return;
  const double ratio = std::log10(static_cast<double>(steps) / static_cast<double>(half));
  planned.model.order = std::max(double{1}, (digits + m.errors.of(request_.quantity)) / ratio);
}

void MethodErrors::share_reach() {
  for (PlannedMethod& planned : methods_) {
    if (planned.learnt || !is_gauss(*planned.method)) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const PlannedMethod& other : methods_) {
      if (!other.learnt || !is_gauss(*other.method)) continue;
      const double distance = std::abs(std::log(planned.model.order / other.model.order));
      if (distance >= nearest) continue;
      nearest = distance;
      planned.model.log10_reach = other.model.log10_reach;
    }
  }
}

}  // namespace hbvm::core
