#include "audit/slope_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/figure_layout.hpp"

namespace hbvm::core {
namespace {

/// What its number takes, in units of the axes.
struct NumberSize {
  double width, height;
};

/// A triangle with its number, in units of the axes.
class TrianglePlace {
 public:
  TrianglePlace(const SlopeTriangle& triangle, const NumberSize& number) : t_(triangle), number_(number) {}

  bool overlaps(const TrianglePlace& other) const {
    return t_.left < other.right() && other.t_.left < right() && bottom() < other.top() && other.bottom() < top();
  }

  /// Whether the triangle or its number stands on a point.
  bool covers(const PlotPoint& x) const {
    if (x[0] < t_.left || x[0] > right() || x[1] < bottom()) return false;
    const double along = (x[0] - t_.left) / (t_.right - t_.left);
    return x[0] <= t_.right ? x[1] <= t_.low + along * (t_.high - t_.low) + number_.height / 4
                            : std::abs(x[1] - (t_.low + t_.high) / 2) < number_.height / 2;
  }

  /// By how much it is below a picture that ends there.
  double below(double end) const { return std::max(double{0}, end - t_.low); }

 private:
  double right() const { return t_.right + number_.width; }
  double bottom() const { return std::min(t_.low, (t_.low + t_.high - number_.height) / 2); }
  double top() const { return std::max(t_.high, (t_.low + t_.high + number_.height) / 2); }

  SlopeTriangle t_;
  NumberSize number_;
};

/// How many curves pass through it.
int crossed(const TrianglePlace& place, const Panel& panel) {
  constexpr int parts = 16;
  return static_cast<int>(std::count_if(panel.curves.begin(), panel.curves.end(), [&](const Curve& curve) {
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      for (int n = 0; n <= parts; ++n) {
        const double w = n / double{parts};
        const PlotPoint &a = curve.points[i - 1], &b = curve.points[i];
        if (place.covers({a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])})) return true;
      }
    return false;
  }));
}

}  // namespace

SlopeTriangle slope_triangle(const std::vector<Rung>& rungs, std::size_t at, int slope) {
  const double decades_below = (1 + slope) / double{4};
  const double right = rungs.at(at - 2).step, left = rungs.at(at).step;
  const double low = rungs[at].error * log10_of_2 - decades_below;
  return {left, right, low, low + slope * (right - left) * log10_of_2, slope};
}

void add_slope_triangle(Panel& panel, const SlopeTriangle& t) {
  panel.lines.push_back({{{t.left, t.low}, {t.right, t.low}, {t.right, t.high}, {t.left, t.low}}});
  panel.labels.push_back({{t.right, (t.low + t.high) / 2}, std::to_string(t.slope)});
}

void add_slope_triangles(Panel& panel, const std::map<int, std::vector<std::vector<Rung>>>& curves) {
  constexpr std::size_t across = 2;
  constexpr double digits = double{5} / 2;  // and the gap before them
  const PanelPlace axes = layout_of(Figure{"", "", "", {panel}}).panels.front();
  const NumberSize number{digits * letter_width * axes.x.length() / box_width,
                          line_height * axes.y.length() / box_height};
  std::vector<TrianglePlace> taken;
  for (const auto& [slope, of_it] : curves) {
    std::optional<SlopeTriangle> best;
    double least = 0;
    for (const std::vector<Rung>& rungs : of_it)
      for (std::size_t at = rungs.size() - 1; at >= across; --at) {
        if (!rungs[at].is_clean()) continue;
        const SlopeTriangle triangle = slope_triangle(rungs, at, slope);
        if (!std::isfinite(triangle.low)) continue;
        const TrianglePlace place(triangle, number);
        const auto overlapped = std::count_if(taken.begin(), taken.end(),
                                              [&](const TrianglePlace& other) { return place.overlaps(other); });
        // Nothing is as bad as another triangle; of equal ones the finest steps of the first curve are taken.
        constexpr double bad = 100;
        const double cost =
            bad * static_cast<double>(overlapped) + crossed(place, panel) + place.below(axes.y.from) / axes.y.length();
        if (best && cost >= least) continue;
        best = triangle;
        least = cost;
      }
    if (!best) continue;
    taken.emplace_back(*best, number);
    add_slope_triangle(panel, *best);
  }
}

}  // namespace hbvm::core
