#pragma once

#include <limits>
#include <map>

#include "audit/quantity.hpp"
#include "reference/reference_motion.hpp"

namespace hbvm::core {

/// Greatest error of a quantity at one step, and what round-off explains of it, as log2.
struct ErrorSize {
  double error, floor;
};
using ErrorSizes = std::map<Quantity, ErrorSize>;
void raise(ErrorSizes& sizes, Quantity quantity, double error, double floor);

/// log2 of the least errors that can be told from the reference's own, by component; the greatest over several starts.
struct Margins {
  static constexpr double none = -std::numeric_limits<double>::infinity();
  double q = none, p = none, lambda = none;

  Margins() = default;
  explicit Margins(const ReferenceMotion::Errors& errors);
  void raise(const Margins& other);
  /// Whether a floor is one of these, and not round-off.
  bool set(double floor) const { return floor == q || floor == p || floor == lambda; }
};

}  // namespace hbvm::core
