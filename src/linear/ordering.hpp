#pragma once

#include <utility>
#include <vector>

#include "linear/index.hpp"

namespace hbvm::core {

/// An order of n things in which those that share an entry of a matrix stand close together.
struct Ordering {
  std::vector<Index> position;  ///< of each thing
  Index half_bandwidth = 0;     ///< largest distance of two that share an entry
};

/// Finds the order by reverse Cuthill-McKee, or keeps the order given if that is no worse.
Ordering order_for_band(Index n, const std::vector<std::pair<Index, Index>>& entries);

}  // namespace hbvm::core
