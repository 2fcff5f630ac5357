#pragma once

#include <string>
#include <vector>

#include "linear/index.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// A part of a scene's start that stays as it is written while the rest is made consistent.
struct HeldPart {
  std::string name;               ///< as it was asked for
  std::vector<Index> positions;   ///< numbers of coordinates whose positions are held
  std::vector<Index> velocities;  ///< of those whose velocities are
  std::string turning = {};       ///< the rigid body whose directors these are
};

/// Parts by their names. A body or a rigid body that is not fixed has a.position, a.velocity, and one coordinate each
/// as a.x and a.vx. A rigid body has a.angle, its orientation, and a.rate, its angular velocity. \throws InputError,
/// with the names there are
std::vector<HeldPart> held_parts(const Scene& scene, const std::vector<std::string>& names);

}  // namespace hbvm::core
