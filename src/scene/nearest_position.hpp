#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// q with g(q) = 0 nearest to `target` in the metric M. Where the search for it does not converge, as from a rough
/// sketch, it is one that Newton's method finds.
/// \throws InputError if none is found, with the constraints that are farthest from being fulfilled
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target);

}  // namespace hbvm::core
