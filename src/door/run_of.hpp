#pragma once

#include "hbvm/run.hpp"
#include "long_work/json.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {

/// What is asked for, read. \param start names the start in messages; without it that of the scene is taken
/// \throws InputError
RunRequest request_of(const hbvm::RunRequest& asked, const std::optional<std::string>& start);
/// The command of the program that makes the same motion.
std::string command_of(const hbvm::RunRequest& asked, const RunRequest& request);

/// A list of a name and a text each.
OrderedJson json_of(const std::vector<Warning>& warnings);

/// The figure of a run: motion, multipliers and errors, with what made it below.
Figure figure_of(const RunRequest& request, const Recording& recording, const std::string& command);
/// Its motion as pictures one after another.
std::vector<Figure> frames_of(const RunRequest& request, const Recording& recording);

}  // namespace hbvm::core
