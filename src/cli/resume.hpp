#pragma once

#include <CLI/CLI.hpp>

#include "integrate/checkpoint.hpp"

namespace hbvm::core {

using GivenOptions = std::vector<std::pair<std::string, std::string>>;

/// The options of a command that were given, as text; not those that say where a run is kept.
GivenOptions given_options(const CLI::App& command);

/// Gives a command what it was given when the checkpoint was written, as if it had been repeated.
/// \throws InputError if something else was given now. Another path to scene, start or trajectory is none: their
///         contents decide; nor is how it prints and how often it is kept
void take_options(CLI::App& command, const std::string& file, const Checkpoint& checkpoint);

}  // namespace hbvm::core
