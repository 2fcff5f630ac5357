#pragma once

#include <span>

#include "problem/effect/kernel.hpp"

namespace hbvm::core {

/// All kernels; defined in the source that effect_kernels prints.
std::span<const Kernel> kernel_table();

}  // namespace hbvm::core
