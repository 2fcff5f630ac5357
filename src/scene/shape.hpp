#pragma once

#include "scene/scene.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {

/// Reads `shape` of a rigid body, a table with one of `box`, `cylinder`, `disc`, `ring` and `sphere`. In space the
/// round ones but the sphere may have an `axis`; all may have `at`. \throws InputError
SceneShape read_shape(TomlTable& body, std::size_t dimension, const Constants& constants);

}  // namespace hbvm::core
