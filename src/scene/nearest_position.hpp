#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// q with g(q) = 0 nearest to `target` in the metric M. From a target so far away that the search for the nearest does
/// not converge, as a rough sketch, it is one that Newton's method finds.
/// \throws InputError if none is found, with the constraints that are farthest from being fulfilled
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target);

}  // namespace hbvm::core
