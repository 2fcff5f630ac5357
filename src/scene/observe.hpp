#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// The scene with one more observation, "swing=angle(a, b)" or "angle(a, b)", which is then its own name. The scene
/// remembers the change as with_number() does. \throws InputError
Scene with_observation(const Scene& scene, const std::string& text);

}  // namespace hbvm::core
