#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hbvm::core {

/// What measured, as far as a number depends on it: the machine, the compiler with its options, the libraries.
std::vector<std::pair<std::string, std::string>> measuring_system();

}  // namespace hbvm::core
