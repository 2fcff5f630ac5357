#pragma once

#include <string>
#include <vector>

#include "run/recording.hpp"

namespace hbvm::core {

/// What pictures call the multipliers that they show, in the order of shown_multipliers(): "ball joint crank-rod, x",
/// "hinge frame-wheel, across e". Where two would have one name, points of bodies are in it. If that is not enough they
/// are numbered.
std::vector<std::string> multiplier_names(const Recording& recording);

}  // namespace hbvm::core
