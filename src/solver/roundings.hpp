#pragma once

#include "method/hbvm.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// C: an upper bound of the lengths of the sums of one sweep over the stage equations, where a sum of n terms carries n
/// roundings, and 4 for what they are passed through.
template <Scalar S>
long roundings_of_a_sweep(const Problem<S>& problem, const Hbvm<S>& method) {
  return static_cast<long>(4 * (method.k + 2 * method.s + method.r + problem.m() + method.s * problem.nu()));
}

}  // namespace hbvm::core
