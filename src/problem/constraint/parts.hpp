#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hbvm::core {

/// The parts of a constraint of a scene that stands for several g. Each has what its name says besides, "point, x", and
/// its form, one of these.
template <class... Form>
using ConstraintParts = std::vector<std::pair<std::string, std::variant<Form...>>>;

}  // namespace hbvm::core
