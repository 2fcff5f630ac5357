#include "scene/add_event.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Crossing direction_of(const std::string& text) {
  if (text.empty() || text == "any") return Crossing::any;
  if (text == "up") return Crossing::up;
  if (text == "down") return Crossing::down;
  throw InputError("'direction' is \"up\", \"down\" or \"any\", and not \"" + text + "\"");
}

}  // namespace

void add_event(Scene& scene, const std::string& name, const std::string& value, const std::string& direction,
               std::size_t line) {
  if (name.empty()) throw InputError("an event without a name");
  if (std::any_of(scene.events.begin(), scene.events.end(),
                  [&](const SceneEvent& other) { return other.name == name; }))
    throw InputError("there is an event '" + name + "' already");
  try {
    scene.events.push_back(
        {name, Expression::parse(value, Expression::Syntax::observation), direction_of(direction), line});
  } catch (const ExpressionError& error) {
    throw InputError("event '" + name + "': " + error.what());
  }
}

Scene with_events_observed(const Scene& scene) {
  Scene result = scene;
  result.observations.clear();
  for (const SceneEvent& event : scene.events) result.observations.push_back({event.name, event.value, event.line});
  return result;
}

Scene with_event(const Scene& scene, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw InputError("--event '" + text + "': use NAME: EXPRESSION");
  std::string name = trimmed(text.substr(0, colon)), direction;
  for (const char* const word : {"up", "down"})
    if (const std::string end = std::string(" ") + word; name.ends_with(end)) {
      direction = word;
      name = trimmed(name.substr(0, name.size() - end.size()));
    }
  Scene changed = scene;
  add_event(changed, name, trimmed(text.substr(colon + 1)), direction);
  changed.changes.push_back("--event '" + text + "'");
  return changed;
}

}  // namespace hbvm::core
