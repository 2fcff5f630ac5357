#pragma once

#include "scene/level_function.hpp"

namespace hbvm::core {

/// Lines of the surface g = 0 within a box of space: where it cuts planes x = const, y = const and z = const. Each
/// plane has a grid. A line goes from one edge of the grid to the next. An edge is halved some times about where g
/// changes its sign, and g is taken as linear on what is left.
std::vector<PointLine> level_lines(const LevelFunction& g, const SpaceBox& box);

/// Into how many parts the box is divided by the planes, and a plane by its grid, along each axis.
constexpr std::size_t level_planes = 12, level_cells = 32;
constexpr int level_halvings = 6;

}  // namespace hbvm::core
