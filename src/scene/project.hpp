#pragma once

#include "scene/assemble.hpp"
#include "scene/hold.hpp"

namespace hbvm::core {

/// The scene with the nearest consistent initial state. q minimises (q - q0)^T M (q - q0) under g(q) = 0, then p is
/// projected to the tangent space there, nearest in the metric M^-1. What changes is written as decimals that read back
/// exactly in the working precision. A body keeps the key, velocity or momentum, that its scene gives. What is held
/// stays as it is written: the rest is the nearest that is consistent with it.
/// \throws InputError if the projection does not converge: the scene is too far from consistent, or contradictory
template <Scalar S>
Scene project(const Scene& scene, const std::vector<HeldPart>& held = {});

}  // namespace hbvm::core
