#pragma once

#include <map>

#include "problem/space/displacement.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// Where bodies, fixed points and attachments are, as displacements from the origin, by their names. A rigid body is
/// where its reference point is. The directors are there too, as "bar.d1".
template <Scalar S>
std::map<std::string, Displacement<S>, std::less<>> places_of(const Scene& scene);

}  // namespace hbvm::core
