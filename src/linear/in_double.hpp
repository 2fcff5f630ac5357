#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// The matrix, or the vector, of the doubles next to the entries: for Jacobians and start values, never for a result.
template <class Array>
auto in_double(const Eigen::PlainObjectBase<Array>& a) {
  Eigen::Matrix<double, Array::RowsAtCompileTime, Array::ColsAtCompileTime> result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = approximately(a.data()[i]);
  return result;
}
/// The same in place, of one size.
template <Scalar S>
void set_in_double(Matrix<double>& to, const Matrix<S>& from) {
  for (Index i = 0; i < from.size(); ++i) to.data()[i] = approximately(from.data()[i]);
}

}  // namespace hbvm::core
