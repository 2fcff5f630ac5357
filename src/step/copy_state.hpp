#pragma once

#include "scalar/in_place.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// to = from, of equal sizes, in place.
template <Scalar S>
void copy_state(State<S>& to, const State<S>& from) {
  for (Index j = 0; j < from.q.size(); ++j) {
    set(to.q[j], from.q[j]);
    set(to.p[j], from.p[j]);
    set(to.q_carry[j], from.q_carry[j]);
    set(to.p_carry[j], from.p_carry[j]);
  }
}

}  // namespace hbvm::core
