#pragma once

#include "scene/scene.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {

/// The directors of a body that is turned by R from the axes of space, row i being R e_i. All are expressions, so that
/// they are orthonormal to the last digit in any precision.
///
/// Turned by an angle in the plane.
SceneMatrix turned_by_angle(const Expression& angle);
/// By a quaternion (w, x, y, z) of any length but 0.
SceneMatrix turned_by_quaternion(const SceneVector& quaternion);
/// About an axis, of any length but 0, by an angle.
SceneMatrix turned_about_axis(const SceneVector& axis, const Expression& angle);
/// By three angles about the axes that `sequence` names, each about an axis of the body as it is turned already.
/// For "zxz" R is R_z(angle 1) R_x(angle 2) R_z(angle 3).
SceneMatrix turned_by_euler_angles(const SceneVector& angles, const std::string& sequence);

/// Reads `orientation` of a rigid body. In the plane it is an angle. In space it is a table with `quaternion`, with
/// `axis` and `angle`, or with `euler` and `sequence`. In both it may be { directors = [...] }. \throws InputError
SceneMatrix read_orientation(TomlTable& body, std::size_t dimension, const Constants& constants);

}  // namespace hbvm::core
