#pragma once

#include "scalar/in_place.hpp"

namespace hbvm::core {

/// x + carry += increment, where x holds the rounded sum and carry the rest (Kahan and Babuska): what is lost is a
/// rounding of the carry. A sum of increment and carry, rounded before it is added, would lose the same bits of a
/// constant increment step after step. s and t are scratch.
template <Scalar S>
void add_compensated(S& x, S& carry, const S& increment, S& s, S& t) {
  HeldScratch<S> rest = scratch<S>();
  set_exact_sum(s, rest, x, increment, t);
  set_sum(rest, rest, carry);
  set_exact_sum(x, carry, s, rest, t);
}

}  // namespace hbvm::core
