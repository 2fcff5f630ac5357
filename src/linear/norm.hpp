#pragma once

#include "linear/matrix.hpp"
#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// sum_j a_j b_j
inline Mpfr inner(const Vector<Mpfr>& a, const Vector<Mpfr>& b) {
  Mpfr sum = 0;
  for (Index j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}
/// The Euclidean norm.
inline Mpfr norm(const Vector<Mpfr>& a) { return sqrt(inner(a, a)); }

}  // namespace hbvm::core
