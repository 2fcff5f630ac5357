#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

inline constexpr int max_quadrature_nodes = 10'000;

/// The Gauss-Legendre formula on [0, 1] with n nodes: int_0^1 f(c) dc = sum_i b_i f(c_i) for f in Pi_{2n-1}.
template <Scalar S>
struct Quadrature {
  Vector<S> c;  ///< abscissae, ascending
  Vector<S> b;  ///< weights
};

/// Abscissae and weights are within 1 ulp of the truth. It is half an ulp and a trifle, as they are computed with guard
/// digits and rounded once. Those near 0 have full relative accuracy. Symmetric to the last bit: c_{n+1-i} = fl(1 -
/// c_i) for c_i < 1/2, and b_{n+1-i} = b_i; take c_{n+1-i} where 1 - c_i is needed. Nothing is cached.
///
/// A root of the Legendre polynomial is found in double. Polynomial and derivative are computed there in full
/// precision, since products by a 53-bit argument are cheap. Legendre's equation gives the Taylor series there.
/// Newton's method on that series gives the root and the derivative at the root.
///
/// \throws InputError unless 1 <= n <= max_quadrature_nodes
template <Scalar S>
Quadrature<S> gauss_legendre(int n);

}  // namespace hbvm::core
