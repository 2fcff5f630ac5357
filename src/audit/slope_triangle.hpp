#pragma once

#include <numbers>

#include "audit/convergence.hpp"
#include "hbvm/figure.hpp"

namespace hbvm::core {

inline constexpr double log10_of_2 = std::numbers::ln2 / std::numbers::ln10;

/// Adds a triangle of this slope a little below a curve of errors. It reaches across two rungs and ends at rung `at`.
/// Axes are log2 of the step and log10 of the error.
void add_slope_triangle(Panel& panel, const std::vector<Rung>& rungs, std::size_t at, int slope);

}  // namespace hbvm::core
