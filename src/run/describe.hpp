#pragma once

#include <string>

#include "scalar/precision.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// What a scene is, for people: dimensions, degrees of freedom, effects, the degree of U and the k that conserves the
/// energy exactly. Also the initial energy, momenta and which are conserved, and the condition of the Gram matrix.
/// \throws InputError as assemble does
std::string describe(const Scene& scene, const Precision& precision);

}  // namespace hbvm::core
