#pragma once

#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// The problem with all numbers rounded to double, for Jacobians and start values.
template <Scalar S>
Problem<double> in_double(const Problem<S>& problem);

#define HBVM_DECLARE(S) extern template Problem<double> in_double<S>(const Problem<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
