#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/eigen.hpp>

#include "hbvm/scalar/scalar.hpp"

namespace hbvm {

using Index = Eigen::Index;

/// Storage only: columns are contiguous. The products and solves of the working precision are in this folder.
template <Scalar S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <Scalar S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// max |a_ij| over all entries; 0 for an empty matrix, NaN if an entry is.
template <Scalar S>
S max_norm(const Matrix<S>& a) {
  S norm = 0;
  for (Index i = 0; i < a.size(); ++i) raise_to(norm, magnitude(a.data()[i]));
  return norm;
}
template <Scalar S>
S max_norm(const Vector<S>& a) {
  S norm = 0;
  for (Index i = 0; i < a.size(); ++i) raise_to(norm, magnitude(a[i]));
  return norm;
}

}  // namespace hbvm
