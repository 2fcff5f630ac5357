#pragma once

#include <cstddef>

namespace hbvm::core {

/// The type of numbers of rows, columns and coordinates, as in Eigen.
using Index = std::ptrdiff_t;

}  // namespace hbvm::core
