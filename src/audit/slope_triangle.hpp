#pragma once

#include <map>
#include <numbers>
#include <vector>

#include "audit/convergence.hpp"
#include "hbvm/figure.hpp"

namespace hbvm::core {

inline constexpr double log10_of_2 = std::numbers::ln2 / std::numbers::ln10;

/// A right angle below the line of a slope. Axes are log2 of the step and log10 of the error.
struct SlopeTriangle {
  double left, right, low, high;
  int slope;
};

/// A little below a curve of errors, across two rungs, ending at rung `at`.
SlopeTriangle slope_triangle(const std::vector<Rung>& rungs, std::size_t at, int slope);
void add_slope_triangle(Panel& panel, const SlopeTriangle& triangle);

/// One triangle for each slope, below one of the curves that have it. It stands where it is on no other triangle and on
/// the fewest curves.
/// \param panel with its curves
void add_slope_triangles(Panel& panel, const std::map<int, std::vector<std::vector<Rung>>>& curves);

}  // namespace hbvm::core
