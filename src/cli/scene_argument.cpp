#include "scene_argument.hpp"

#include <iostream>
#include <iterator>

#include "hbvm/error.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

/// Standard input can be read but once.
const std::string& standard_input() {
  static const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  return text;
}

}  // namespace

void SceneArgument::add_to(CLI::App& command) {
  command.add_option("scene", name, "Scene file, - for standard input, or a name that `hbvm scenes` lists")->required();
  add_settings_to(command);
}

void SceneArgument::add_settings_to(CLI::App& command) {
  command
      .add_option("--set", settings,
                  "NAME=VALUE: another value of a constant, or of a body's mass or charge, as a.mass=3; repeatable")
      ->allow_extra_args(false);
}

void SceneArgument::add_observations_to(CLI::App& command) {
  command
      .add_option(
          "--observe", observations,
          "NAME=FORMULA or FORMULA: also tell its value along the motion, as 'angle(a, b)' or 'T=tension(o, bob)'; "
          "repeatable")
      ->allow_extra_args(false);
  command
      .add_option("--event", events,
                  "NAME: EXPRESSION: tell when its value crosses 0, and the state there, as 'turn: bob.vx'; upwards or "
                  "downwards alone as 'turn up: bob.vx'; repeatable")
      ->allow_extra_args(false);
}

std::vector<std::string> SceneArgument::changes() const {
  std::vector<std::string> options;
  for (const std::string& setting : settings) options.push_back("--set '" + setting + "'");
  for (const std::string& observation : observations) options.push_back("--observe '" + observation + "'");
  for (const std::string& event : events) options.push_back("--event '" + event + "'");
  return options;
}

hbvm::Scene SceneArgument::load() const {
  hbvm::Scene scene = name == "-" ? hbvm::read_scene(standard_input(), name) : hbvm::load_scene(name);
  for (const std::string& setting : settings) {
    const std::size_t at = setting.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == setting.size())
      throw InputError("--set " + setting + ": use NAME=VALUE, as L=1.2 or a.mass=3");
    scene.set(setting.substr(0, at), setting.substr(at + 1));
  }
  for (const std::string& observation : observations) {
    const std::size_t at = observation.find('=');
    try {
      scene.observe(observation.substr(0, at), at == std::string::npos ? observation : observation.substr(at + 1));
    } catch (const InputError& error) {
      throw InputError("--observe " + observation + ": " + error.what());
    }
  }
  for (const std::string& event : events) scene.event(event);
  return scene;
}

std::string SceneArgument::text() const {
  if (!settings.empty() || !observations.empty() || !events.empty()) return load().toml();
  return name == "-" ? standard_input() : scene_text(name);
}

}  // namespace hbvm::core
