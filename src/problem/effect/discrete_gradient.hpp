#pragma once

#include "problem/effect/term.hpp"

namespace hbvm::core {

/// DU(x0, x1) of an effect, a discrete gradient: DU . (x1 - x0) = U(x1) - U(x0), symmetric in x0 and x1, and dU/dx
/// where they meet (Gonzalez 1996). The rules of differentiation are used backwards through U's own operations, with
/// the difference quotient of each in place of its derivative,
///
///     D(a b) = (b0 + b1)/2 Da + (a0 + a1)/2 Db,    D(1/a) = -Da / (a0 a1),    D(sqrt a) = Da / (sqrt a0 + sqrt a1),
///     D(exp a) = exp(am) sinhc(d) Da,    D(sin a) = cos(am) sinc(d) Da,    D(log a) = atanhc(d/am) Da / am,
///     D(tanh a) = sinhc(2d) Da / (cosh a0 cosh a1),
///     D(atan a) = 4 c0 c1 atanc((b1 - b0)/(1 + b0 b1)) Da / (1 + b0 b1)^2,  c = 1/(1 + sqrt(1 + a^2)), b = a c,
///
/// and so on, am = (a0 + a1)/2, d = (a1 - a0)/2: nothing is divided by a difference that may vanish, and no digits
/// cancel. |x|^2 has the quotient x0 + x1. So DU of a central effect lies along the mean displacement, and is Gonzalez'
/// quotient of U as a function of |x|^2. Of an axial effect it is in the plane of that and the axis. So it keeps what
/// rotations keep.
template <Scalar S>
struct DiscreteGradient {
  Program<S> program;      ///< as many outputs as U has inputs, from x0, x1 (twice as many) and the coefficients
  Matrix<S> coefficients;  ///< instances x coefficients
};
template <Scalar S>
DiscreteGradient<S> discrete_gradient(const EffectTerm<S>& term, Index inputs);

}  // namespace hbvm::core
