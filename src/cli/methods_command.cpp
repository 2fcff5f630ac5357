#include <iostream>
#include <memory>

#include "commands.hpp"
#include "hbvm/method.hpp"

namespace hbvm::core {

void add_methods_command(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* const command =
      app.add_subcommand("methods", "List the methods: how they are written, their order, what they keep, their work");
  command->add_flag("--json", *json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm methods");
  command->callback([json] {
    const std::vector<MethodKind> kinds = methods();
    std::cout << (*json ? to_json(kinds) + "\n" : to_text(kinds)) << std::flush;
  });
}

}  // namespace hbvm::core
