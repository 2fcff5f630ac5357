#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Orthonormal shifted Legendre polynomials (18): int_0^1 P_i P_j = delta_ij, P_j(1) = sqrt(2j + 1).
/// Both functions evaluate by recurrence in the precision of the call, so give coefficients guard digits.

/// values(i, j) = P_j(c_i), j < count. The c_i need not lie in [0, 1].
template <Scalar S>
Matrix<S> legendre_values(const Vector<S>& c, int count);

/// integrals(i, j) = int_0^{c_i} P_j(x) dx, j < count, by (31): xi_{j+1} P_{j+1} - xi_j P_{j-1}.
template <Scalar S>
Matrix<S> legendre_integrals(const Vector<S>& c, int count);
/// The same from the values of one function more.
template <Scalar S>
Matrix<S> legendre_integrals(const Matrix<S>& values);

/// xi_j = 1 / (2 sqrt|4 j^2 - 1|) of (32); xi_0 = 1/2.
template <Scalar S>
S xi(int j);

/// X_s of (32): the s x s tridiagonal matrix with int_0^c P_j = sum_i P_i(c) X_s(i, j) at the s Gauss nodes.
template <Scalar S>
Matrix<S> X_matrix(int s);

/// T(i, j), upper triangular, with P_j(1 + c) = sum_{i <= j} P_i(c) T(i, j), by the recurrence in j.
template <Scalar S>
Matrix<S> legendre_shift(int count);

}  // namespace hbvm::core
