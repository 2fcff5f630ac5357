#pragma once

#include "step/method.hpp"

namespace hbvm::core {

/// Radau IIA, see radau(): "S", or "S+project" and the other formulations. RungeKuttaStepper says what becomes of
/// constraints. \throws InputError
MethodPtr radau_method(std::string_view arguments);

}  // namespace hbvm::core
