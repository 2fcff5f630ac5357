#include <iostream>
#include <memory>

#include "commands.hpp"
#include "hbvm/scene.hpp"

namespace hbvm::core {

void add_scenes_command(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* const command = app.add_subcommand("scenes", "List the built-in scenes");
  command->add_flag("--json", *json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm scenes");
  command->callback([json] {
    const std::vector<SceneEntry> entries = scenes();
    std::cout << (*json ? to_json(entries) + "\n" : to_text(entries)) << std::flush;
  });
}

}  // namespace hbvm::core
