#pragma once

#include "scene/level_function.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// The constraints on the position of a body alone: planes, quadrics and formulas. Each is the function that vanishes.
std::vector<LevelFunction> holding(const Scene& scene, const SceneBody& body);

/// What bodies are held on, in lines.
struct HeldOn {
  std::vector<PointLine> meshes = {};  ///< of surfaces
  std::vector<PointLine> curves = {};  ///< where one function vanishes in the plane, or two in space

  bool empty() const { return meshes.empty() && curves.empty(); }
};

/// The surfaces and curves within the space that bodies move in and around it. What several bodies are held on alike is
/// there once. \param states of the scene's coordinates that the bodies go through, at least one
HeldOn held_on(const Scene& scene, const std::vector<std::vector<double>>& states);

}  // namespace hbvm::core
