#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// The scene with another number: of a constant by its name, "L", or of a body, "a.mass" or "a.charge". The scene keeps
/// its name, and remembers the change for commands that make it again.
/// \throws InputError for what there is not, with what there is
Scene with_number(const Scene& scene, const std::string& what, const Expression& value);

/// What follows the scene's name in a command: " --set 'L=1.2'" or " --observe 'x=a.x'" for each change.
std::string settings_in_command(const Scene& scene);

}  // namespace hbvm::core
