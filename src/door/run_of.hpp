#pragma once

#include "hbvm/run.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {

/// A run as people are told of it. The trajectory and pictures are left out.
/// \param command of the program, which makes the same motion
Run run_of(const RunRequest& request, const RunResult& result, const std::string& command);

}  // namespace hbvm::core
