#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "hbvm/scene.hpp"

namespace hbvm::core {

/// The scene of a command, and what is set in it.
struct SceneArgument {
  std::string name;                            ///< a file, "-" for standard input, or a name that `hbvm scenes` lists
  std::vector<std::string> settings;           ///< "L=1.2"
  std::vector<std::string> observations = {};  ///< "tip=a.x", or "a.x"
  std::vector<std::string> events = {};        ///< "turn: a.vx", "turn up: a.vx"

  /// Adds SCENE and --set, or --set alone.
  void add_to(CLI::App& command);
  void add_settings_to(CLI::App& command);
  /// Adds --observe, where there is something to be told along the motion.
  void add_observations_to(CLI::App& command);
  /// \throws InputError
  hbvm::Scene load() const;
  /// The options that make it of what its name stands for: "--set 'L=1.2'".
  std::vector<std::string> changes() const;
  /// As it is written, comments and all; with settings as it is read. \throws InputError
  std::string text() const;
};

}  // namespace hbvm::core
