#pragma once

#include <vector>

#include "hard_cases/case.hpp"
#include "hard_cases/collection.hpp"
#include "long_work/cells.hpp"

namespace hbvm::core {

struct StabilityOptions : CellOptions {
  Collection collection = Collection::quick;  ///< that the cases are of: in the full one they run longer
};

/// Runs and judges each case, in a process of its own. One that crashes or finds no end is not as expected, and takes
/// no other with it. To be called while the program has a single thread.
/// \return a finding a case, in order; of a shard, those of its cases alone. The outcome is the same whatever the
/// number of processes and shards. What differs is the time it took, and a case that comes to its end just within its
/// seconds or not
/// \throws Error if a process cannot be started
std::vector<CaseFinding> stability(const std::vector<HardCase>& cases, const StabilityOptions& options);

}  // namespace hbvm::core
