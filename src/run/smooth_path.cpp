#include "run/smooth_path.hpp"

#include <algorithm>
#include <cmath>

namespace hbvm::core {
namespace {

double length(const PlotPoint& x) { return std::hypot(x[0], x[1]); }

/// Whether the cubic is the way that was gone. Both ends lead on along the straight way, and neither is much longer.
bool fits(const PathPoint& from, const PathPoint& to) {
  constexpr double longest = 2;
  const double passed = to.t - from.t;
  const PlotPoint way{to.at[0] - from.at[0], to.at[1] - from.at[1]};
  const auto leads_on = [&](const PlotPoint& velocity) {
    return (velocity[0] * way[0] + velocity[1] * way[1]) * passed >= 0 &&
           length(velocity) * std::abs(passed) <= longest * length(way);
  };
  return leads_on(from.velocity) && leads_on(to.velocity);
}

/// x at the share c of the way, 0 to 1.
double between(double c, double x0, double v0, double x1, double v1) {
  const double d = 1 - c;
  return d * d * (1 + 2 * c) * x0 + c * d * d * v0 + c * c * (1 + 2 * d) * x1 - c * c * d * v1;
}

}  // namespace

std::vector<PlotPoint> smooth_path(const std::vector<PathPoint>& points, std::size_t at_least) {
  std::vector<PlotPoint> line;
  if (points.empty()) return line;
  const std::size_t parts = std::max<std::size_t>(1, at_least / points.size());
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const PathPoint &from = points[i], &to = points[i + 1];
    line.push_back(from.at);
    if (!fits(from, to)) continue;
    const double passed = to.t - from.t;
    for (std::size_t part = 1; part < parts; ++part) {
      const double c = static_cast<double>(part) / static_cast<double>(parts);
      PlotPoint& at = line.emplace_back();
      for (std::size_t j = 0; j < 2; ++j)
        at[j] = between(c, from.at[j], passed * from.velocity[j], to.at[j], passed * to.velocity[j]);
    }
  }
  line.push_back(points.back().at);
  return line;
}

}  // namespace hbvm::core
