#include <iostream>
#include <memory>

#include "commands.hpp"
#include "unexpected_word.hpp"

namespace hbvm::core {

void add_help_command(CLI::App& app) {
  auto path = std::make_shared<std::vector<std::string>>();
  CLI::App* const command = app.add_subcommand("help", "Explain a command, as its --help does");
  command->add_option("command", *path, "A command, and one of its own: scene check");
  command->footer("Example: hbvm help scene check");
  command->callback([path, &app] {
    const CLI::App* explained = &app;
    std::string name = app.get_name();
    for (const std::string& word : *path) {
      explained = find_command(*explained, word);
      name += " " + word;
    }
    std::cout << app.get_formatter()->make_help(explained, name, CLI::AppFormatMode::Normal);
  });
}

}  // namespace hbvm::core
