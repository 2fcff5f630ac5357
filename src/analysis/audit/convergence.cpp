#include "hbvm/analysis/audit/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  const double count = needed;
  double mean_step = 0, mean_error = 0;
  for (const Rung& r : clean) {
    mean_step += r.step / count;
    mean_error += r.error / count;
  }
  double xx = 0, xy = 0;
  for (const Rung& r : clean) {
    xx += (r.step - mean_step) * (r.step - mean_step);
    xy += (r.step - mean_step) * (r.error - mean_error);
  }
  rate.value = xy / xx;
  double squares = 0;
  for (const Rung& r : clean) {
    const double residual = r.error - mean_error - rate.value * (r.step - mean_step);
    squares += residual * residual;
  }
  const double standard_error = std::sqrt(squares / (count - 2) / xx);
  const Rung &last = clean[needed - 1], &before = clean[needed - 2];
  const double finest = (before.error - last.error) / (before.step - last.step);
  rate.uncertainty = std::max(student_t * standard_error, std::abs(finest - rate.value));
  rate.decades = (clean.front().error - clean.back().error) * std::numbers::ln2 / std::numbers::ln10;
  return rate;
}

}  // namespace hbvm
