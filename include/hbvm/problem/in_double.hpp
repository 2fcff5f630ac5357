#pragma once

#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// The problem with all numbers rounded to double, for Jacobians and start values.
template <Scalar S>
Problem<double> in_double(const Problem<S>& problem);

/// Whether that is the problem with all its digits but the last, also for such a step: the exponents of masses and step
/// leave room for products of two.
template <Scalar S>
bool fits_double(const Problem<S>& problem, const S& step);

#define HBVM_DECLARE(S)                                            \
  extern template Problem<double> in_double<S>(const Problem<S>&); \
  extern template bool fits_double<S>(const Problem<S>&, const S&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
