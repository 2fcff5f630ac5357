#include "cost/cost_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "cost/calibration.hpp"
#include "cost/cost_methods.hpp"
#include "cost/error_model.hpp"
#include "scalar/literal.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

/// Digits of a precision that rounding takes.
constexpr double rounding_digits = double{3} / 2;

/// Right digits that runs of a precision are to have.
struct Window {
  double least, most;
};

/// Operations of a step, NaN where none can be made.
struct CountedStep {
  double operations = std::numeric_limits<double>::quiet_NaN(), operations_in_double = 0;

  /// About, at what they typically cost: no clock has a say in what cells there are.
  double seconds(const Precision& precision) const {
    constexpr double nanoseconds = 1'000'000'000;
    // Work in double beside many digits is products of matrices, and solutions with them.
    constexpr double of_products = double{1} / 4;
    return (operations * typical_nanoseconds(precision) +
            operations_in_double * of_products * typical_nanoseconds(Precision::parse("double"))) /
           nanoseconds;
  }
};

/// Counted over two steps of a usual size, or a quarter of it.
CountedStep count_step(const CostStudy& study, const MethodPtr& method, const Precision& precision,
                       double usual_steps) {
  constexpr long few = 2;
  constexpr double always = std::numeric_limits<double>::infinity();
  // To choose k would take longer than all steps.
  const HbvmMethod* const hbvm = as_hbvm(*method);
  const MethodPtr made = hbvm && hbvm->name().is_auto() ? hbvm_of({2 * hbvm->name().s, hbvm->name().s}) : method;
  for (const double steps : {usual_steps, 4 * usual_steps}) {
    const CostCell cell{made, precision, std::max(1L, static_cast<long>(std::ceil(steps)))};
    const CostSample sample = sample_cost(study.scene, study.until, cell, few, always);
    if (!sample.failure.empty()) continue;
    // Of methods on the index-reduced equations the forces alone are counted, and neither sums nor constraints. The
    // constraints cost more: eight times the sums, about.
    const bool forces_alone = !method->kept().constraints && !as_hbvm(*method);
    const double coordinates = 3 * static_cast<double>(std::max<std::size_t>(1, study.scene.bodies.size()));
    const double sums = forces_alone ? 8 * coordinates * std::pow(method->terms(), 2) : double{0};
    return {std::max(sample.operations, sums), sample.operations_in_double};
  }
  return {};
}

/// Numbers of steps from one to another, each twice the one before, or the root of 2 times.
std::vector<long> ladder(double from, double to, bool fine) {
  std::vector<long> steps;
  const int first = static_cast<int>(std::floor(2 * std::log2(std::max(from, double{1}))));
  for (int j = std::max(0, fine ? first : first - first % 2); j <= 2 * 40; j += fine ? 1 : 2) {
    const long n = std::lround(std::exp2(j / double{2}));
    if (steps.empty() || n > steps.back()) steps.push_back(n);
    if (static_cast<double>(n) >= to) break;
  }
  return steps;
}

/// Numbers of steps of a method that divides them: none to speak of, and as many as others would make.
std::vector<long> divided_steps(double usual_steps) {
  const long usual = std::max(2L, std::lround(usual_steps));
  return {1, usual};
}

/// Some of them, so that no more than so many are left, the last among them.
std::vector<long> thinned(const std::vector<long>& steps, std::size_t most) {
  if (steps.size() <= most) return steps;
  std::vector<long> result;
  for (std::size_t i = 0; i < most; ++i) result.push_back(steps[i * (steps.size() - 1) / (most - 1)]);
  return result;
}

double time_of(const CostStudy& study, const Expression& time) {
  const PrecisionScope scope(Precision::min_digits);
  return approximately(evaluate<Mpfr>(time, study.scene.constants));
}

}  // namespace

double usual_steps(const CostStudy& study, const MotionNature& nature) {
  return time_of(study, study.until) / std::exp2(nature.log2_radius - 2);
}

double counted_seconds(const CostStudy& study, const MethodPtr& method, const Precision& precision,
                       const MotionNature& nature) {
  return count_step(study, method, precision, usual_steps(study, nature)).seconds(precision);
}

std::string times_text(const Expression& until, int times) {
  const std::string& text = until.text();
  const bool is_whole = text.find_first_not_of("0123456789") == std::string::npos && text.size() < 9;
  return is_whole ? std::to_string(std::stol(text) * times) : fmt::format("({})*{}", text, times);
}

long times_of(const Expression& time, const CostStudy& study) {
  return std::lround(time_of(study, time) / time_of(study, study.until));
}

double reachable_digits(const Precision& precision, const MotionNature& nature) {
  return precision.digits() + double{1} - nature.digits_lost - rounding_digits;
}

std::vector<Precision> default_precisions(double most_digits, const MotionNature& nature) {
  std::vector<Precision> result;
  double reached = 0;
  for (const char* const name : {"double", precision_of_34_digits()})
    if (reached < most_digits) {
      result.push_back(Precision::parse(name));
      reached = reachable_digits(result.back(), nature);
    }
  if (result.size() == 1) return result;
  for (const int digits : {30, 50, 100, 200, 500, 1'000, 2'000, 5'000}) {
    const double wanted = std::min(static_cast<double>(digits), most_digits);
    const auto working = std::max(Precision::min_digits,
                                  static_cast<unsigned>(std::ceil(wanted + nature.digits_lost + 2 * rounding_digits)));
    result.push_back(Precision::parse("mpfr:" + std::to_string(working)));
    if (digits >= most_digits) break;
  }
  return result;
}

std::vector<CostCell> cost_grid(const CostStudy& study, const MotionNature& nature) {
  const std::vector<Precision> precisions =
      study.precisions.empty() ? default_precisions(study.most_digits, nature) : study.precisions;
  const double until = time_of(study, study.until), usual = usual_steps(study, nature);
  // Where there are more digits than double has the operations of a step hardly depend on their number.
  std::map<std::pair<std::string, Precision::Kind>, CountedStep> counts;
  const auto counted = [&](const MethodPtr& method, const Precision& precision) {
    const auto [place, is_new] = counts.try_emplace({method->key(), precision.kind()});
    if (is_new) {
      const Precision few_digits = Precision::parse("mpfr:40");
      const bool many = precision.kind() == Precision::Kind::mpfr && precision.digits() > few_digits.digits();
      place->second = count_step(study, method, many ? few_digits : precision, usual);
    }
    return place->second;
  };
  std::vector<CostCell> cells;
  for (const Precision& precision : precisions) {
    const double reach = std::min(reachable_digits(precision, nature), study.most_digits + 1);
    // Half of the digits are enough to see where the next smaller precision is the better one.
    const Window window{std::max(study.least_digits, precision == precisions.front() ? 0 : reach / 2), reach};
    for (const MethodPtr& method : study.methods) {
      if (!suits(*method, precision)) continue;
      const double order = method->order() > 0 ? method->order() : 4;
      const ErrorModel model{order, std::log10(typical_reach(*method)) + nature.log2_radius * std::log10(double{2}),
                             nature.digits_lost};
      // Hypotheses of the model may be off.
      constexpr double margin = double{3} / 2;
      const double from = until / std::pow(10, model.log10_step(std::max(window.least - margin, double{0}))),
                   to = until / std::pow(10, model.log10_step(window.most + margin));
      constexpr int fine_from = 8;
      constexpr std::size_t most_rungs = 8;
      std::vector<long> steps = method->digits() ? divided_steps(usual) : ladder(from, to, order >= fine_from);
      // No step takes less than that; those of few stages would be counted for nothing.
      constexpr double least_step_seconds = double{3} / 10'000'000;
      const auto too_long = [&](double seconds) {
        return [&, seconds](long n) {
          const double made = method->digits() ? usual : static_cast<double>(n);
          return !(made * seconds <= study.most_seconds);
        };
      };
      std::erase_if(steps, too_long(least_step_seconds * typical_nanoseconds(precision)));
      if (steps.empty()) continue;
      std::erase_if(steps, too_long(counted(method, precision).seconds(precision)));
      if (steps.empty()) continue;
      for (const long n : thinned(steps, most_rungs)) cells.push_back({method, precision, n});
    }
  }
  // The same on every machine, as that of the standard library need not be.
  std::mt19937_64 random(1);
  for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[random() % i]);
  return cells;
}

}  // namespace hbvm::core
