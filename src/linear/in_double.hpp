#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// The matrix, or the vector, of the doubles next to the entries: for Jacobians and start values, never for a result.
template <Scalar S>
Matrix<double> in_double(const Matrix<S>& a) {
  Matrix<double> result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = approximately(a.data()[i]);
  return result;
}
/// The same in place, of one size.
template <Scalar S>
void set_in_double(Matrix<double>& to, const Matrix<S>& from) {
  for (Index i = 0; i < from.size(); ++i) to.data()[i] = approximately(from.data()[i]);
}
template <Scalar S>
Vector<double> in_double(const Vector<S>& a) {
  Vector<double> result(a.size());
  for (Index i = 0; i < a.size(); ++i) result[i] = approximately(a[i]);
  return result;
}

}  // namespace hbvm::core
