#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hbvm::core {

/// The names of the commands of a command.
std::vector<std::string> command_names(const CLI::App& app);

/// The options of a command as one writes them: "--method", "-h".
std::vector<std::string> option_names(const CLI::App& command);

/// \throws InputError with the nearest one if there is no such command
const CLI::App* find_command(const CLI::App& app, const std::string& name);

/// What is wrong with the first word that no option took, if there is one: what was meant, and of which command.
std::string unexpected_word(const CLI::App& app);

}  // namespace hbvm::core
