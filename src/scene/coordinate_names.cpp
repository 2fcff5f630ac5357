#include "scene/coordinate_names.hpp"

namespace hbvm::core {

std::vector<std::string> coordinate_names(const Scene& scene, const std::string& of) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& owner) {
    for (int axis = 0; axis < scene.dimension; ++axis) names.push_back(owner + "." + of + "xyz"[axis]);
  };
  for (const SceneBody& body : scene.bodies) add(body.name);
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    if (!body.fixed) add(body.name);
    for (int d = 1; d <= scene.dimension; ++d) add(body.name + ".d" + std::to_string(d));
  }
  return names;
}

}  // namespace hbvm::core
