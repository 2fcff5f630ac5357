#pragma once

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

/// x += increment, where carry holds what earlier roundings took (Kahan); increment is used up, t is scratch.
template <Scalar S>
void add_compensated(S& x, S& carry, S& increment, S& t) {
  set_sum(increment, increment, carry);
  set_sum(t, x, increment);
  set_difference(x, t, x);
  set_difference(carry, increment, x);
  set(x, t);
}

}  // namespace hbvm
