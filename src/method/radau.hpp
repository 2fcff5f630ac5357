#pragma once

#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// Radau IIA with s stages: the collocation method at the roots of P_s - P_{s-1}, Legendre polynomials on [0, 1].
/// The last root is 1. It is of order 2s - 1 and L-stable; with one stage it is the implicit Euler method.
/// Every number is rounded once. The fixed-point iteration of its stages wants short steps.
///
/// Source: Hairer, Wanner: Solving Ordinary Differential Equations II, section IV.5.
/// \throws InputError unless 1 <= s <= max_s
template <Scalar S>
RungeKutta<S> radau(int s);

}  // namespace hbvm::core
