#pragma once

#include <string>

#include "scene/scene.hpp"

namespace hbvm::core {

/// The text of a scene with the start of another one of the same bodies. Entries of positions, velocities, momenta,
/// directors and angular velocities that differ are replaced where they stand. Comments and all else stay as they are.
/// \throws InputError if the text is no TOML
std::string with_start(const std::string& toml, const Scene& start);

}  // namespace hbvm::core
