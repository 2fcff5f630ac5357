#include "scene/observe.hpp"

#include <algorithm>

namespace hbvm::core {

Scene with_observation(const Scene& scene, const std::string& text) {
  const std::size_t at = text.find('=');
  SceneObservation made{
      at == std::string::npos ? text : text.substr(0, at),
      Expression::parse(at == std::string::npos ? text : text.substr(at + 1), Expression::Syntax::observation)};
  if (made.name.empty()) throw InputError("an observation without a name: '" + text + "'; use NAME=VALUE");
  if (std::any_of(scene.observations.begin(), scene.observations.end(),
                  [&](const SceneObservation& other) { return other.name == made.name; }))
    throw InputError("'" + made.name + "' is observed already");
  Scene changed = scene;
  changed.observations.push_back(std::move(made));
  changed.changes.push_back("--observe '" + text + "'");
  return changed;
}

}  // namespace hbvm::core
