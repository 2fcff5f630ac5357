#include <fmt/format.h>

#include "commands.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

void add_scenes_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("scenes", "List the built-in scenes");
  command->footer("Example: hbvm scenes");
  command->callback([] {
    for (const auto& [name, text] : built_in_scenes()) fmt::print("{:<28} {}\n", name, read_scene(text, name).title);
  });
}

}  // namespace hbvm::core
