#pragma once

#include "hbvm/scene.hpp"
#include "scalar/precision.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// What a scene is: dimensions, degrees of freedom, effects, the degree of U. Also the initial energy, momenta and
/// which are conserved, and the condition of the Gram matrix. \throws InputError as assemble does
SceneFacts describe(const Scene& scene, const Precision& precision);

}  // namespace hbvm::core
