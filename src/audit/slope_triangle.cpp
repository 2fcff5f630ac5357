#include "audit/slope_triangle.hpp"

namespace hbvm::core {

void add_slope_triangle(Panel& panel, const std::vector<Rung>& rungs, std::size_t at, int slope) {
  const double decades_below = (1 + slope) / double{4};
  const double right = rungs.at(at - 2).step, left = rungs.at(at).step;
  const double low = rungs[at].error * log10_of_2 - decades_below, high = low + slope * (right - left) * log10_of_2;
  panel.lines.push_back({{{left, low}, {right, low}, {right, high}, {left, low}}});
  panel.labels.push_back({{right, (low + high) / 2}, std::to_string(slope)});
}

}  // namespace hbvm::core
