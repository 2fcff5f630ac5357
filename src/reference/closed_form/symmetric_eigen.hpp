#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// A = Q diag(values) Q^T of a symmetric matrix, in the digits of the scope, by Jacobi's rotations (Golub and Van Loan,
/// Matrix Computations, 8.5).
struct SymmetricEigen {
  explicit SymmetricEigen(Matrix<Mpfr> a);
  Vector<Mpfr> values;
  Matrix<Mpfr> vectors;  ///< Q, a vector a column; its determinant is 1
};

}  // namespace hbvm::core
