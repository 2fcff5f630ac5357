#include <fmt/format.h>

#include <algorithm>

#include "hbvm/scene.hpp"
#include "long_work/json.hpp"
#include "scene/scene.hpp"

namespace hbvm {
namespace {

void add_once(std::vector<std::string>& kinds, const std::string& kind) {
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
}

SceneEntry entry_of(const std::string& name, const std::string& text) {
  const core::Scene scene = core::read_scene(text, name);
  SceneEntry entry;
  entry.name = name;
  entry.title = scene.title;
  entry.source = scene.source;
  entry.dimension = scene.dimension;
  entry.bodies = static_cast<long>(scene.bodies.size());
  entry.rigid_bodies = static_cast<long>(scene.rigid_bodies.size());
  for (const core::SceneConstraint& constraint : scene.constraints) add_once(entry.constraints, constraint.kind);
  for (const core::SceneEffect& effect : scene.effects) add_once(entry.effects, effect.kind);
  return entry;
}

}  // namespace

std::vector<SceneEntry> scenes() {
  std::vector<SceneEntry> entries;
  for (const auto& [name, text] : core::all_scenes()) entries.push_back(entry_of(name, text));
  return entries;
}

std::string to_text(const std::vector<SceneEntry>& scenes) {
  std::string text;
  for (const SceneEntry& scene : scenes) text += fmt::format("{:<28} {}\n", scene.name, scene.title);
  return text;
}

std::string to_json(const std::vector<SceneEntry>& scenes) {
  core::OrderedJson list = core::OrderedJson::array();
  for (const SceneEntry& scene : scenes)
    list.push_back({{"name", scene.name},
                    {"title", scene.title},
                    {"source", scene.source},
                    {"dimension", scene.dimension},
                    {"bodies", scene.bodies},
                    {"rigid_bodies", scene.rigid_bodies},
                    {"constraints", scene.constraints},
                    {"effects", scene.effects}});
  return core::dumped({{"scenes", list}}, 2);
}

}  // namespace hbvm
