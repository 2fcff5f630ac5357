#pragma once

#include <cstddef>
#include <vector>

namespace hbvm::core {

/// A point of a work-precision diagram.
struct CostPoint {
  double seconds = 0, error = 0;  ///< log10 of the error
};

/// The places of those that no other beats in both, from the quickest to the most precise. Points that are not finite
/// are none.
std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points);

}  // namespace hbvm::core
