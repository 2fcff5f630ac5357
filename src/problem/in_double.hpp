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

}  // namespace hbvm::core
