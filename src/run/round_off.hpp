#pragma once

#include <cmath>

namespace hbvm::core {

/// The units of round-off that a run of so many steps explains: a few roundings each step, of either sign.
inline double round_off_units(long steps) { return 16 * (1 + std::sqrt(static_cast<double>(steps))); }

}  // namespace hbvm::core
