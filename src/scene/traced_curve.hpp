#pragma once

#include "scene/level_function.hpp"

namespace hbvm::core {

/// The curve on which functions vanish, from a point of it both ways until it leaves the box or comes back. There is
/// one function in the plane, and two in space. It is followed by its tangent, and each point brought back by Newton's
/// iteration. It ends where that fails. \param dimension 2 or 3
PointLine traced_curve(const std::vector<LevelFunction>& g, const std::array<double, 3>& start, const SpaceBox& box,
                       int dimension);

}  // namespace hbvm::core
