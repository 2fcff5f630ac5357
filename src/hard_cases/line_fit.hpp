#pragma once

#include <vector>

namespace hbvm::core {

/// The line through points (x, y) by least squares.
struct LineFit {
  double slope = 0, standard_error = 0;  ///< of the slope, from the scatter of the points; 0 for two points
};

/// \param x, y as many of each, at least two different x
LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hbvm::core
