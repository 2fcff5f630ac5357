#pragma once

#include <cstddef>

namespace hbvm::core {

/// Of rows, columns and coordinates; Eigen's.
using Index = std::ptrdiff_t;

}  // namespace hbvm::core
