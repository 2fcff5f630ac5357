#pragma once

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// How far from 0, over the size of its terms, a constraint may be that a scene fulfils. Each term is a product of up
/// to three numbers, each an expression of some operations with a rounding each. 64 units leave room for that.
template <Scalar S>
S consistency_tolerance() {
  return S(64) * epsilon<S>();
}

/// g(q) as a sum of terms, and the sum of their magnitudes, which its round-off is proportional to.
template <Scalar S>
struct ConstraintValue {
  S g = 0, size = 0;

  void add(const S& term) {
    g += term;
    size += magnitude(term);
  }

  /// Whether g is 0 but for rounding; not if it is NaN.
  bool vanishes() const { return magnitude(g) <= consistency_tolerance<S>() * size; }
};

}  // namespace hbvm::core
