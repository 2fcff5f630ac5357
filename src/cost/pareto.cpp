#include "cost/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace hbvm::core {

std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].seconds) && std::isfinite(points[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const CostPoint &x = points[a], &y = points[b];
    return x.seconds != y.seconds ? x.seconds < y.seconds : x.error < y.error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

}  // namespace hbvm::core
