#include "hard_cases/line_fit.hpp"

#include <cmath>
#include <numeric>

namespace hbvm::core {

LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), double{0}) / count;
  const double mean_y = std::accumulate(y.begin(), y.end(), double{0}) / count;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  LineFit fit{xy / xx, 0};
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - mean_y - fit.slope * (x[i] - mean_x);
    squares += residual * residual;
  }
  if (x.size() > 2) fit.standard_error = std::sqrt(squares / (count - 2) / xx);
  return fit;
}

}  // namespace hbvm::core
