#include "hbvm/analysis/audit/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hbvm/analysis/line_fit.hpp"

namespace hbvm {

std::optional<Rate> convergence_rate(const std::vector<Rung>& rungs) {
  constexpr std::size_t needed = 5;
  constexpr double student_t = 3182 / double{1000};  // 97.5 % quantile, needed - 2 degrees of freedom
  std::vector<Rung> clean;
  std::copy_if(rungs.begin(), rungs.end(), std::back_inserter(clean), [](const Rung& r) { return r.is_clean(); });
  if (clean.size() < needed) return std::nullopt;
  clean.erase(clean.begin(), clean.end() - needed);

  Rate rate;
  rate.halvings = clean.front().step - clean.back().step;
  if (rate.halvings < needed - 1) return std::nullopt;
  std::vector<double> steps, errors;
  for (const Rung& r : clean) {
    steps.push_back(r.step);
    errors.push_back(r.error);
  }
  const LineFit fit = fit_line(steps, errors);
  rate.value = fit.slope;
  const Rung &last = clean[needed - 1], &before = clean[needed - 2];
  const double finest = (before.error - last.error) / (before.step - last.step);
  rate.uncertainty = std::max(student_t * fit.standard_error, std::abs(finest - rate.value));
  rate.decades = (clean.front().error - clean.back().error) * std::numbers::ln2 / std::numbers::ln10;
  return rate;
}

}  // namespace hbvm
