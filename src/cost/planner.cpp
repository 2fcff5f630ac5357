#include "cost/planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cost/calibration.hpp"
#include "cost/cost_cell.hpp"
#include "cost/cost_grid.hpp"
#include "cost/cost_methods.hpp"
#include "hbvm/error.hpp"
#include "method_errors.hpp"

namespace hbvm::core {
namespace {

/// A setting on the way to the pick.
struct Trial {
  std::size_t method;
  PlannedSetting setting;
  bool done = false;  ///< run, or given up
  int attempts = 0;
};

class Planner {
 public:
  Planner(const PlanRequest& request, const MotionNature& nature, const CostJudge& judge)
      : request_(request), nature_(nature), errors_(request, nature, judge) {}

  Plan plan() {
    constexpr double part_of_learning = double{3} / 10;
    errors_.learn([this](double part) { report(part_of_learning * part); });
    propose();
    improve();
    return result();
  }

 private:
  void report(double part) const {
    if (request_.progress) request_.progress(part);
  }

  /// Digits beyond the asked ones, as models are a little off.
  double aimed_digits() const { return request_.digits + (15 + request_.digits) / double{100}; }

  std::vector<Precision> precisions() const {
    if (!request_.precisions.empty()) return request_.precisions;
    // How far a motion magnifies errors of its start bounds what it does to rounding, and may be far from it. So a
    // precision that may do is tried; if it does not, a greater one is at hand.
    constexpr double sure = 1;
    const MotionNature harmless{};
    std::vector<Precision> result;
    for (const char* const name : {"double", precision_of_34_digits()}) {
      const Precision precision = Precision::parse(name);
      if (reachable_digits(precision, harmless) >= request_.digits) result.push_back(precision);
      if (precision.kind() == Precision::Kind::binary64 &&
          reachable_digits(precision, nature_) >= request_.digits + sure)
        return result;
    }
    // An error that is made on the way may grow more than one of the start: of bodies that pass near one another.
    for (const int guard : {3, 12}) {
      const int digits = request_.digits + static_cast<int>(std::ceil(nature_.digits_lost)) + guard;
      result.push_back(
          Precision::parse("mpfr:" + std::to_string(std::max(static_cast<int>(Precision::min_digits), digits))));
    }
    return result;
  }

  /// A trial of each method in each precision, without those that are far too dear at first sight.
  void propose() {
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, Trial>> all;
    for (const Precision& precision : precisions())
      for (std::size_t m = 0; m < errors_.methods().size(); ++m) {
        const double log10_h = errors_.methods()[m].model.log10_step(aimed_digits());
        PlannedSetting setting{errors_.methods()[m].method, precision};
        if (setting.method->digits()) {
          // Found out by running it.
          setting.steps = 1;
          if (may_divide_well(*setting.method, precision)) all.emplace_back(0, Trial{m, setting});
          continue;
        }
        if (!errors_.has_steps(log10_h)) continue;
        setting.steps = errors_.steps_of(log10_h);
        const double stages = errors_.methods()[m].method->terms();
        const double at_first_sight =
            static_cast<double>(setting.steps) * std::pow(stages + 2, double{3} / 2) * typical_nanoseconds(precision);
        least = std::min(least, at_first_sight);
        all.emplace_back(at_first_sight, Trial{m, setting});
      }
    constexpr double far_too_dear = 30;
    std::erase_if(all, [&](const auto& entry) { return entry.first > far_too_dear * least; });
    double part = 0;
    for (auto& [dear, trial] : all) {
      report((3 + 2 * part++ / static_cast<double>(all.size())) / 10);
      predict(trial);
      trials_.push_back(trial);
    }
  }

  /// Whether the digits asked of a method that divides its steps fit the request. What the motion leaves of them is to
  /// be enough, and not much more.
  bool may_divide_well(const Method& method, const Precision& precision) const {
    constexpr double further = 6;
    const double asked = *method.digits();
    return suits(method, precision) &&
           (method.kept().energy ||
            (asked >= request_.digits && asked <= request_.digits + nature_.digits_lost + further));
  }

  double predicted_digits(const Trial& trial) const {
    const Method& method = *trial.setting.method;
    if (!method.digits()) return errors_.model(trial.method).digits(errors_.log10_step(trial.setting.steps));
    return method.kept().energy ? reachable_digits(trial.setting.precision, nature_)
                                : *method.digits() - nature_.digits_lost;
  }

  /// Time and error of the trial's step, by the models.
  void predict(Trial& trial) {
    PlannedSetting& setting = trial.setting;
    setting.step = step_text(request_.until, setting.steps);
    setting.predicted_error = -predicted_digits(trial);
    setting.seconds.reset();
    setting.error.reset();
    constexpr long most = 8;
    constexpr double enough = double{1} / 20;
    constexpr int repetitions = 2;
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < repetitions; ++n) {
      const CostSample sample =
          sample_cost(request_.scene, request_.until, {setting.method, setting.precision, setting.steps}, most, enough);
      if (!sample.failure.empty()) {
        // It is tried with smaller steps.
        constexpr double smaller = double{13} / 10;
        if (setting.method->digits() || ++trial.attempts > most_attempts) {
          trial.done = true;
          return;
        }
        setting.steps = std::max(setting.steps + 1, std::lround(smaller * static_cast<double>(setting.steps)));
        return predict(trial);
      }
      best = std::min(best, sample.seconds);
      setting.operations = sample.operations;
    }
    constexpr double nanoseconds_a_second = 1'000'000'000;
    setting.nanoseconds = setting.operations > 0 ? nanoseconds_a_second * best / setting.operations : 0;
    setting.predicted_seconds = static_cast<double>(setting.steps) * best;
  }

  Trial* most_promising() {
    Trial* best = nullptr;
    for (Trial& trial : trials_)
      if (!trial.done && (!best || trial.setting.predicted_seconds < best->setting.predicted_seconds)) best = &trial;
    return best;
  }

  /// The quickest measured setting that has the digits, or none.
  const PlannedSetting* quickest() const {
    const PlannedSetting* best = nullptr;
    for (const PlannedSetting& s : measured_)
      if (*s.error <= -request_.digits && (!best || *s.seconds < *best->seconds)) best = &s;
    return best;
  }

  void improve() {
    constexpr int most_runs = 24;
    // A prediction is not as sure as a measurement, least of all that of a short run, which it costs nothing to make.
    constexpr double usual_doubt = double{23} / 20, doubt_of_short = 2, short_seconds = double{1} / 100;
    while (runs_ < most_runs) {
      report((1 + runs_ / double{most_runs}) / 2);
      Trial* const trial = most_promising();
      if (!trial) break;
      const PlannedSetting* const best = quickest();
      const double doubt = best && *best->seconds < short_seconds ? doubt_of_short : usual_doubt;
      if (best && trial->setting.predicted_seconds > doubt * *best->seconds) break;
      run(*trial);
    }
  }

  void run(Trial& trial) {
    PlannedSetting& setting = trial.setting;
    ++runs_;
    const CostMeasurement m =
        errors_.run(setting.method, setting.precision, setting.steps, {3, 9, double{1} / 20, false});
    PlannedMethod& planned = errors_.methods()[trial.method];
    const double digits = m.failure.empty() ? -m.errors.of(request_.quantity) : 0;
    if (m.failure.empty()) {
      setting.seconds = m.seconds;
      setting.error = -digits;
      measured_.push_back(setting);
    }
    trial.done = true;
    if (setting.method->digits()) return;
    const bool has = digits >= request_.digits;
    const long before = setting.steps;
    const double log10_h = errors_.log10_step(before);
    // What rounding alone leaves is no matter of the step.
    const double rounding = reachable_digits(setting.precision, nature_) - 1;
    const bool is_rounding = m.failure.empty() && digits > rounding && digits < planned.model.digits(log10_h) - 1;
    if (m.failure.empty() && digits > 0 && !is_rounding) {
      planned.model = planned.model.corrected(log10_h, digits);
      planned.learnt = true;
      errors_.share_reach();
      for (Trial& other : trials_)
        if (&other != &trial && !other.done && is_gauss(*other.setting.method)) move(other);
    }
    const long wanted = errors_.steps_of(planned.model.log10_step(aimed_digits()));
    constexpr double gain = double{19} / 20;
    if (++trial.attempts > most_attempts) return;
    if (has) {
      if (static_cast<double>(wanted) > gain * static_cast<double>(before)) return;
      setting.steps = wanted;
    } else {
      if (is_rounding) return;
      constexpr double smaller = double{13} / 10;
      setting.steps = std::max(
          before + 1, m.failure.empty() && digits > 0 ? wanted : std::lround(smaller * static_cast<double>(before)));
    }
    const auto same = [&](const PlannedSetting& s) {
      return s.method->key() == setting.method->key() && s.precision == setting.precision && s.steps == setting.steps;
    };
    if (std::any_of(measured_.begin(), measured_.end(), same)) return;
    trial.done = false;
    predict(trial);
  }

  /// To the step that its model now asks for, at the cost of a step that is known.
  void move(Trial& trial) {
    PlannedSetting& setting = trial.setting;
    const double log10_h = errors_.methods()[trial.method].model.log10_step(aimed_digits());
    if (!errors_.has_steps(log10_h)) {
      trial.done = true;
      return;
    }
    const double second_a_step = setting.predicted_seconds / static_cast<double>(setting.steps);
    setting.steps = errors_.steps_of(log10_h);
    setting.step = step_text(request_.until, setting.steps);
    setting.predicted_seconds = second_a_step * static_cast<double>(setting.steps);
    setting.predicted_error = -predicted_digits(trial);
  }

  Plan result() {
    const PlannedSetting* const best = quickest();
    if (!best) {
      std::string nearest;
      double most = -std::numeric_limits<double>::infinity();
      for (const PlannedSetting& s : measured_)
        if (-*s.error > most) {
          most = -*s.error;
          nearest = "; nearest is " + s.method->text() + ", step " + s.step + ", " + s.precision.name() + ", with " +
                    std::to_string(static_cast<int>(most)) + " digits";
        }
      throw IntegrationError("nothing was found that leaves " + std::to_string(request_.digits) +
                             " right digits at t = " + request_.until.text() + nearest);
    }
    Plan plan{*best, {}, nature_, {}, runs_};
    // Of each other method and precision the best that was found, measured first.
    std::vector<PlannedSetting> others;
    for (const PlannedSetting& s : measured_)
      if (*s.error <= -request_.digits) others.push_back(s);
    for (const Trial& trial : trials_)
      if (!trial.setting.seconds && trial.setting.predicted_seconds > 0) others.push_back(trial.setting);
    const auto time = [](const PlannedSetting& s) { return s.seconds.value_or(s.predicted_seconds); };
    std::stable_sort(others.begin(), others.end(),
                     [&](const PlannedSetting& a, const PlannedSetting& b) { return time(a) < time(b); });
    constexpr std::size_t most = 5;
    for (const PlannedSetting& s : others) {
      const auto same = [&](const PlannedSetting& other) {
        return other.method->key() == s.method->key() && other.precision == s.precision;
      };
      if (same(plan.pick) || std::any_of(plan.runners_up.begin(), plan.runners_up.end(), same)) continue;
      if (plan.runners_up.size() < most) plan.runners_up.push_back(s);
    }
    return plan;
  }

  static constexpr int most_attempts = 5;

  const PlanRequest& request_;
  const MotionNature& nature_;
  MethodErrors errors_;
  std::vector<Trial> trials_;
  std::vector<PlannedSetting> measured_;
  int runs_ = 0;
};

}  // namespace

Plan plan_cost(const PlanRequest& request) {
  if (request.digits < 1 || request.digits > most_reference_digits - 50)
    throw InputError("--digits " + std::to_string(request.digits) + ": use 1 to " +
                     std::to_string(most_reference_digits - 50));
  const auto none = [&](double) {
    if (request.progress) request.progress(0);
  };
  const MotionNature nature = find_nature(request.scene, request.until, nullptr, none);
  constexpr int further_digits = 4;
  const CostReference reference = find_cost_reference({.scene = &request.scene,
                                                       .until = request.until,
                                                       .digits = request.digits + further_digits,
                                                       .confirmed = false,
                                                       .progress = none});
  const CostJudge judge(request.scene, reference.state, reference.digits);
  if (request.quantity == CostQuantity::lambda && !judge.has_multipliers())
    throw InputError("--quantity lambda: '" + request.scene.name + "' has no constraints, and so no multipliers");
  Plan plan = Planner(request, nature, judge).plan();
  plan.reference = reference;
  return plan;
}

}  // namespace hbvm::core
