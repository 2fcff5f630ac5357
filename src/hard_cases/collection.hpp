#pragma once

#include <vector>

#include "hard_cases/case.hpp"

namespace hbvm::core {

enum class Collection {
  quick,  ///< of each family some cases, and short runs: a minute
  full    ///< all, in double, quad and 50 digits, with runs of 10^7 steps: an hour
};

/// The hard cases, family after family.
std::vector<HardCase> hard_cases(Collection collection);

}  // namespace hbvm::core
