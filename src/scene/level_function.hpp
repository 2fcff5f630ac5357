#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// g at many points, a row each of as many columns as space has dimensions. Where g has no value it is not finite.
using LevelFunction = std::function<Vector<double>(const Matrix<double>& points)>;

/// Points one after another, in the plane with z = 0.
using PointLine = std::vector<std::array<double, 3>>;

/// A part of space; in the plane its z is from 0 to 0.
struct SpaceBox {
  std::array<double, 3> low{}, high{};

  double length(std::size_t axis) const { return high[axis] - low[axis]; }
  double longest() const { return std::max({length(0), length(1), length(2)}); }
};

}  // namespace hbvm::core
