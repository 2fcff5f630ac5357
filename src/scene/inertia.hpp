#pragma once

#include "scene/scene.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {

/// The second moment S about the reference point, as expressions. J is the inertia tensor about the centre of mass c:
/// S = tr(J)/2 I - J + m c c^T. In the plane J is a number, and S = J/2 I + m c c^T.
/// \param inertia one entry in the plane; in space the rows of J
SceneMatrix second_moment_of(const SceneMatrix& inertia, const Expression& mass, const SceneVector& center);

/// Reads `inertia` of a rigid body. In the plane it is a number. In space it is the three principal moments about the
/// directors, or a matrix. \throws InputError
SceneMatrix read_inertia(TomlTable& body, std::size_t dimension);

}  // namespace hbvm::core
