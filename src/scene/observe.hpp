#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// The scene with one more observation. One that is called as its formula reads has no name of its own. The scene
/// remembers the change as with_number() does. \throws InputError
Scene with_observation(const Scene& scene, const std::string& name, const std::string& formula);

}  // namespace hbvm::core
