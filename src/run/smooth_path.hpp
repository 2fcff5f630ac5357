#pragma once

#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// A point of a path and its velocity there.
struct PathPoint {
  double t;
  PlotPoint at, velocity;
};

/// The path as a line of about so many points or more. Between two given points it is the cubic that has their
/// positions and velocities (Hermite's). Where the velocities do not fit the way between them, as where the motion
/// turns often from one to the next, it is straight.
std::vector<PlotPoint> smooth_path(const std::vector<PathPoint>& points, std::size_t at_least);

}  // namespace hbvm::core
