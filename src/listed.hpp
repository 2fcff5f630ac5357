#pragma once

#include <string>
#include <vector>

namespace hbvm::core {

/// "a, b, c", and of a long list the first: "a, b, c, d, e, f, g, h, and 3 more".
std::string listed(const std::vector<std::string>& names);

}  // namespace hbvm::core
