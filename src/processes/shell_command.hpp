#pragma once

#include <filesystem>
#include <string>

namespace hbvm::core {

/// Runs a command by the shell, in the folder where the program is, with nothing to read. What it prints goes to a
/// file. When the work is asked to end, or the time is over, the command ends with all that it started.
/// \param seconds that it may take; 0: any
/// \throws Error with the command, how it ended and the last lines that it printed, unless it ends with code 0
/// \throws Interrupted
void run_shell_command(const std::string& command, double seconds, const std::filesystem::path& prints_to);

/// An argument as the shell reads it back.
std::string shell_quoted(const std::string& argument);

}  // namespace hbvm::core
