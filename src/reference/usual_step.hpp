#pragma once

#include "scalar/expression.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// A step for a run for which none is asked, in the units of the scene. It is at most an eighth of the least radius of
/// convergence that a Taylor series shows in its first fifty steps. It is the greatest power of 2 of which `until` is a
/// multiple, or else `until` over a power of 2.
/// \throws InputError where there is no series or the motion runs into a singularity, with the cause
/// \throws InputError if `until` has no positive value in the scene's constants
Expression usual_step(const Scene& scene, const Expression& until);

}  // namespace hbvm::core
