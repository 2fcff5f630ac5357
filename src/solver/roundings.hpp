#pragma once

#include "method/hbvm.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// C, a bound of the roundings of one sweep over the stage equations. A sum of n terms carries n, and 4 is for what it
/// is passed through.
template <Scalar S>
long roundings_of_a_sweep(const Problem<S>& problem, const Hbvm<S>& method) {
  return static_cast<long>(4 * (method.k + 2 * method.s + method.r + problem.m() + method.s * problem.nu()));
}

}  // namespace hbvm::core
