#include "scene/set_number.hpp"

#include "hbvm/error.hpp"
#include "nearest.hpp"

namespace hbvm::core {
namespace {

/// The number of a body that is named so, or null.
Expression* number_of_body(Scene& scene, const std::string& body, const std::string& key) {
  for (SceneBody& one : scene.bodies) {
    if (one.name != body) continue;
    if (key == "mass" && one.mass) return &*one.mass;
    if (key == "charge" && one.charge) return &*one.charge;
  }
  for (SceneRigidBody& one : scene.rigid_bodies)
    if (one.name == body && key == "mass") return &one.mass;
  return nullptr;
}

/// All that can be set.
std::vector<std::string> settable(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, value] : scene.constants) names.push_back(name);
  for (const SceneBody& body : scene.bodies) {
    if (body.mass) names.push_back(body.name + ".mass");
    if (body.charge) names.push_back(body.name + ".charge");
  }
  for (const SceneRigidBody& body : scene.rigid_bodies) names.push_back(body.name + ".mass");
  return names;
}

}  // namespace

Scene with_number(const Scene& scene, const std::string& what, const Expression& value) {
  Scene changed = scene;
  const std::size_t point = what.rfind('.');
  if (const auto constant = changed.constants.find(what); constant != changed.constants.end()) {
    constant->second = value;
  } else if (Expression* const number = point == std::string::npos
                                            ? nullptr
                                            : number_of_body(changed, what.substr(0, point), what.substr(point + 1))) {
    *number = value;
  } else {
    const std::vector<std::string> names = settable(scene);
    throw InputError(scene.name + ": there is no number '" + what + "' to set" +
                     (names.empty() ? "; the scene has no constants" : did_you_mean_or_list(what, names)));
  }
  const std::vector<std::string> changes = std::move(changed.changes);
  changed = read_scene(write_scene(changed), scene.name);
  changed.changes = changes;
  changed.changes.push_back("--set '" + what + "=" + value.text() + "'");
  return changed;
}

std::string settings_in_command(const Scene& scene) {
  std::string text;
  for (const std::string& change : scene.changes) text += " " + change;
  return text;
}

}  // namespace hbvm::core
