#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "audit/finding.hpp"
#include "hbvm/error.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Errors of some quantities in one precision.
using Ladders = std::map<Quantity, std::vector<Rung>>;

/// The time that the claims may take is over.
class LimitReached : public Error {
 public:
  using Error::Error;
};

/// The states of a motion that a method starts from. State i lies about lead + i stride steps of an eighth of the time
/// scale after the scene's own start.
struct Starts {
  int count = 1;
  long lead = 3, stride = 2;
};

/// The claims about one method on one problem that one series of runs decides. Not empty.
struct ClaimGroup {
  std::vector<Claim> claims;
  Starts starts;
  int log2_scale = 0;      ///< of the motion's time scale
  int log2_interval = -1;  ///< of the time in which errors are looked at, over the time scale
  long windows = 1;        ///< how often that time follows upon itself
  /// log2 of what the numbers of the method are rounded to, besides the precision of a run.
  double log2_rounding = -std::numeric_limits<double>::infinity();
  double stop_at = 0;  ///< thread_seconds() at which to stop, 0: never

  const Claim& subject() const { return claims.front(); }
  bool asks_for(Quantity quantity) const;
  /// Whether the finest rung of each quantity asked for is lost in round-off.
  bool is_lost(const Ladders& ladders) const;
  /// log2 of the unit of round-off in S, or of what the method's numbers are rounded to.
  template <Scalar S>
  double log2_unit() const {
    return std::max(static_cast<double>(1 - significand_bits<S>()), log2_rounding);
  }
  /// What a reference must exceed.
  int stages() const;
  /// \throws LimitReached
  void check_time() const;
};

}  // namespace hbvm::core
