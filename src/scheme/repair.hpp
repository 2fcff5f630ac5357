#pragma once

#include <string>
#include <vector>

#include "scheme/met_orders.hpp"

namespace hbvm::core {

/// An entry, and the value with which all conditions hold.
struct MendedEntry {
  std::size_t entry = 0;
  std::string value;  ///< as many decimals as the numbers have, or the conditions give
  std::string exact;  ///< the fraction or square root that it is; empty if it is none
};

/// What a scheme may be meant to be.
struct Repair {
  std::vector<std::vector<MendedEntry>> ways;  ///< each changes the fewest entries; more than one: it is not determined
  long conditions = 0;                         ///< all of which hold then
};

/// The fewest entries, beside those that are unknown, whose change meets all conditions of each part up to its target.
/// Sets of one entry and of two are tried. A set counts only where the conditions determine it: their Jacobian has full
/// rank there, and there are more conditions than entries. Newton's iteration, in double and then in the digits of the
/// scope.
/// \param targets an order for each part; 0 leaves it out
/// \throws Interrupted
Repair repair_of(const Scheme& scheme, const Rounding& rounding, const std::vector<int>& targets, int most_entries);

}  // namespace hbvm::core
