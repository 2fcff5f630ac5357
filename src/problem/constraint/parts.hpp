#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hbvm::core {

/// What a constraint of a scene gives that stands for several g: for each what its name says besides, "point, x", and
/// its form, one of these.
template <class... Form>
using ConstraintParts = std::vector<std::pair<std::string, std::variant<Form...>>>;

}  // namespace hbvm::core
