#pragma once

#include <map>
#include <vector>

#include "hbvm/analysis/audit/claim.hpp"

namespace hbvm {

/// Errors of some quantities in one precision.
using Ladders = std::map<Quantity, std::vector<Rung>>;

/// The claims about one method on one problem that one series of runs decides. Not empty.
struct Cell {
  std::vector<Claim> claims;
  int first_start = 0, starts = 1;
  int log2_interval = -1;

  const Claim& subject() const { return claims.front(); }
  bool asks_for(Quantity quantity) const;
  /// Whether the finest rung of each quantity asked for is lost in round-off.
  bool is_lost(const Ladders& ladders) const;
  /// s, or the tableau's number of stages: what a reference must exceed. No order that is asked for needs more than 20.
  int stages() const;
};

}  // namespace hbvm
