#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// A matrix or vector, rounded to the digits of the scope. (Not by way of a Matrix<Mpfr>: the copy would take the
/// digits of the scope before.)
template <Scalar S, class Array>
auto rounded(const Array& a) {
  Eigen::Matrix<S, Array::RowsAtCompileTime, Array::ColsAtCompileTime> r(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) r.data()[i] = rounded_to<S>(raw(a.data()[i]));
  return r;
}

}  // namespace hbvm::core
