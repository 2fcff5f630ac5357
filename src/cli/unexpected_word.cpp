#include "unexpected_word.hpp"

#include "hbvm/error.hpp"
#include "nearest.hpp"

namespace hbvm::core {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  const auto named = app.get_subcommands([&](const CLI::App* c) { return c->get_name() == name; });
  if (!named.empty()) return named.front();
  throw InputError("unknown command '" + name + "'" + did_you_mean(name, command_names(app)) + " (see hbvm --help)");
}

std::string unexpected_word(const CLI::App& app) {
  const CLI::App* command = &app;
  std::string path = "hbvm";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    path += " " + command->get_name();
  }
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) return {};
  // An option that is not known leaves its value behind, too.
  for (const std::string& word : words)
    if (word.starts_with("-")) {
      const std::string option = word.substr(0, word.find('='));
      return "unknown option '" + option + "'" + did_you_mean(option, option_names(*command)) + " (see " + path +
             " --help)";
    }
  return "unexpected '" + words.front() + "' (see " + path + " --help)";
}

}  // namespace hbvm::core
