#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/eigen.hpp>
#include <concepts>

#include "linear/index.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

static_assert(std::same_as<Index, Eigen::Index>);

/// Storage only: columns are contiguous. The products and solves of the working precision are in this folder.
template <Scalar S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <Scalar S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// bound = max(bound, |x|), in place; a NaN wins.
template <Scalar S>
void raise_magnitude(S& bound, const S& x) {
  if constexpr (std::same_as<S, Mpfr>) {
    if (mpfr_cmpabs(raw(x), raw(bound)) > 0 || mpfr_nan_p(raw(x))) mpfr_abs(raw(bound), raw(x), MPFR_RNDN);
  } else {
    raise_to(bound, magnitude(x));
  }
}

/// norm = max |a_i|, in place, over a matrix or vector; 0 if it is empty, NaN if an entry is.
template <Scalar S, class Derived>
void set_max_norm(S& norm, const Eigen::PlainObjectBase<Derived>& a) {
  norm = 0;
  for (Index i = 0; i < a.size(); ++i) raise_magnitude(norm, a.data()[i]);
}

/// The same as a new value.
template <class Array>
typename Array::Scalar max_norm(const Eigen::PlainObjectBase<Array>& a) {
  typename Array::Scalar norm = 0;
  set_max_norm(norm, a);
  return norm;
}

/// A matrix or vector of |a_i|.
template <class Array>
Array magnitudes(Array a) {
  for (Index i = 0; i < a.size(); ++i) a.data()[i] = magnitude(a.data()[i]);
  return a;
}

/// max |a_i - b_i|.
template <Scalar S>
S distance(const Vector<S>& a, const Vector<S>& b) {
  return max_norm(Vector<S>(a - b));
}

}  // namespace hbvm::core
