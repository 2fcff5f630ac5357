#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "scene/scene.hpp"
#include "unexpected_word.hpp"

namespace hbvm::core {
namespace {

bool takes_a_scene(const CLI::App& command) { return command.get_option_no_throw("scene") != nullptr; }

/// One case of the script for a command and each of its own: what may stand after it.
void print_cases(const CLI::App& command, const std::string& path) {
  std::vector<std::string> words = command_names(command);
  for (std::string& option : option_names(command)) words.push_back(std::move(option));
  fmt::print("    \"{}\") words=\"{}{}\" ;;\n", path, fmt::join(words, " "), takes_a_scene(command) ? " $scenes" : "");
  for (const CLI::App* const sub : command.get_subcommands({}))
    print_cases(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name());
}

void print_completion(const CLI::App& app) {
  fmt::print(
      "# Completion of hbvm's commands, options and scenes for bash (zsh: after bashcompinit):\n"
      "#   source <(hbvm completion)\n"
      "_hbvm() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" path=\"\" words=\"\" i\n"
      "  local scenes=\"");
  for (const auto& [name, text] : all_scenes()) fmt::print("{} ", name);
  fmt::print(
      "\"\n"
      "  for ((i = 1; i < COMP_CWORD && i < 3; ++i)); do\n"
      "    case \"$path ${{COMP_WORDS[i]}}\" in\n"
      "      ");
  std::vector<std::string> paths;
  for (const CLI::App* const command : app.get_subcommands({})) {
    paths.push_back("\" " + command->get_name() + "\"");
    for (const std::string& sub : command_names(*command))
      paths.push_back("\"" + command->get_name() + " " + sub + "\"");
  }
  fmt::print(
      "{}) path=\"${{path:+$path }}${{COMP_WORDS[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$path\" in\n",
      fmt::join(paths, " | "));
  print_cases(app, "");
  fmt::print(
      "  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "}}\n"
      "complete -o default -F _hbvm hbvm\n");
}

}  // namespace

void add_completion_command(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("completion", "Print a script that completes commands, options and scenes");
  command->footer("Example: source <(hbvm completion)");
  command->callback([&app] { print_completion(app); });
}

}  // namespace hbvm::core
