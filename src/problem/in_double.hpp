#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// The problem with all numbers rounded to double, for Jacobians and start values.
template <Scalar S>
Problem<double> in_double(const Problem<S>& problem);

/// Whether x, and whether the problem, is that with all its digits but the last. The exponents of x, and of the masses,
/// leave room for products of two.
template <Scalar S>
bool fits_double(const S& x);
template <Scalar S>
bool fits_double(const Problem<S>& problem);

#define HBVM_DECLARE(S)                                            \
  extern template Problem<double> in_double<S>(const Problem<S>&); \
  extern template bool fits_double<S>(const S&);                   \
  extern template bool fits_double<S>(const Problem<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm::core
