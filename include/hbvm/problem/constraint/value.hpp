#pragma once

#include "hbvm/scalar/scalar.hpp"

namespace hbvm {

/// g(q) as a sum of terms, and the sum of their magnitudes, which its round-off is proportional to.
template <Scalar S>
struct ConstraintValue {
  S g = 0, size = 0;

  void add(const S& term) {
    g += term;
    size += magnitude(term);
  }
};

}  // namespace hbvm
