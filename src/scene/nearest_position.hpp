#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// q with g(q) = 0 nearest to `target` in the metric M.
/// \throws InputError if none is found: the target is too far away, or the constraints contradict one another
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target);

}  // namespace hbvm::core
