#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// The coordinates of q as tables name them, in order: "upper.x", "upper.y", ... of a body. Then "top.x", ... of a
/// rigid body's reference point unless it is fixed, then "top.d1.x", ..., "top.d3.z" of its directors, two in the
/// plane. \param of what stands before the axis: "p" gives those of p, "upper.px"
std::vector<std::string> coordinate_names(const Scene& scene, const std::string& of = "");

}  // namespace hbvm::core
