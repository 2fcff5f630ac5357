#include "scene/observe.hpp"

#include <algorithm>

namespace hbvm::core {

Scene with_observation(const Scene& scene, const std::string& name, const std::string& formula) {
  if (name.empty()) throw InputError("an observation without a name: '" + formula + "'");
  if (name.find('=') != std::string::npos) throw InputError("the name of an observation has no '=': '" + name + "'");
  if (std::any_of(scene.observations.begin(), scene.observations.end(),
                  [&](const SceneObservation& other) { return other.name == name; }))
    throw InputError("'" + name + "' is observed already");
  Scene changed = scene;
  changed.observations.push_back({name, Expression::parse(formula, Expression::Syntax::observation)});
  changed.changes.push_back("--observe '" + (name == formula ? formula : name + "=" + formula) + "'");
  return changed;
}

}  // namespace hbvm::core
