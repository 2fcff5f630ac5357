#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// q with g(q) = 0 nearest to `target` in the metric M.
/// \throws InputError if none is found: the target is too far away, or the constraints contradict one another
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target);

#define HBVM_DECLARE(S) extern template Vector<S> nearest_position<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm::core
