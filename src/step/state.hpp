#pragma once

#include "linear/matrix.hpp"
#include "scalar/archive.hpp"

namespace hbvm::core {

/// The propagated state. q_carry and p_carry are what rounding took from q and p in the last update. The next one gives
/// it back (compensated summation), so that the sums lose no digits over many steps.
template <Scalar S>
struct State {
  Vector<S> q, p, q_carry, p_carry;

  State(const Vector<S>& q0, const Vector<S>& p0)
      : q(q0), p(p0), q_carry(Vector<S>::Zero(q0.size())), p_carry(Vector<S>::Zero(p0.size())) {}

  void remember(Archive& archive) { archive(q, p, q_carry, p_carry); }
};

}  // namespace hbvm::core
