#include "basis/legendre.hpp"

#include <cmath>

#include "scalar/in_place.hpp"

namespace hbvm::core {

using std::sqrt;

template <Scalar S>
Matrix<S> legendre_values(const Vector<S>& c, int count) {
  // (j + 1) L_{j+1} = (2 j + 1) x L_j - j L_{j-1} for polynomials L with L(1) = 1.
  Matrix<S> values(c.size(), count);
  S t, u;
  for (Index i = 0; i < c.size(); ++i) {
    const S x = 2 * c[i] - 1;
    for (int j = 0; j < count; ++j) {
      if (j < 2) {
        values(i, j) = j == 0 ? S(1) : x;
        continue;
      }
      set_product(t, x, values(i, j - 1));
      set_difference(u, t, values(i, j - 2));
      set_product(u, u, S(j - 1));
      set_quotient(u, u, S(j));
      set_sum(values(i, j), t, u);
    }
  }
  for (int j = 1; j < count; ++j) {
    const S scale = sqrt(S(2 * j + 1));
    for (Index i = 0; i < c.size(); ++i) set_product(values(i, j), values(i, j), scale);
  }
  return values;
}

template <Scalar S>
S xi(int j) {
  return 1 / (2 * sqrt(S(std::abs(4 * j * j - 1))));
}

template <Scalar S>
Matrix<S> X_matrix(int s) {
  Matrix<S> X = Matrix<S>::Zero(s, s);
  X(0, 0) = xi<S>(0);
  for (int j = 1; j < s; ++j) {
    X(j, j - 1) = xi<S>(j);
    X(j - 1, j) = -X(j, j - 1);
  }
  return X;
}

template <Scalar S>
Matrix<S> legendre_integrals(const Vector<S>& c, int count) {
  return legendre_integrals<S>(legendre_values<S>(c, count + 1));
}

template <Scalar S>
Matrix<S> legendre_integrals(const Matrix<S>& values) {
  const Index count = values.cols() - 1;
  Matrix<S> integrals(values.rows(), count);
  S t;
  for (Index j = 0; j < count; ++j) {
    const S above = xi<S>(static_cast<int>(j) + 1), below = xi<S>(static_cast<int>(j));
    for (Index i = 0; i < values.rows(); ++i) {
      S& integral = integrals(i, j);
      set_product(integral, above, values(i, j + 1));
      if (j == 0)
        set_sum(integral, integral, below);
      else
        subtract_product(integral, below, values(i, j - 1), t);
    }
  }
  return integrals;
}

template <Scalar S>
Matrix<S> legendre_shift(int count) {
  // (j + 1) L_{j+1} = (2 j + 1) x L_j - j L_{j-1} at x = 2 c + 1 = (2 c - 1) + 2. There (2 c - 1) L_i is ((i + 1)
  // L_{i+1} + i L_{i-1}) / (2 i + 1), for polynomials L with L(1) = 1.
  Matrix<S> T = Matrix<S>::Zero(count, count);
  if (count > 0) T(0, 0) = 1;
  for (int j = 0; j + 1 < count; ++j)
    for (int i = 0; i <= j + 1; ++i) {
      S shifted = 2 * T(i, j);
      if (i > 0) shifted += S(i) / (2 * i - 1) * T(i - 1, j);
      if (i < j) shifted += S(i + 1) / (2 * i + 3) * T(i + 1, j);
      S next = (2 * j + 1) * shifted;
      if (j > 0) next -= j * T(i, j - 1);
      T(i, j + 1) = next / (j + 1);
    }
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < j; ++i) T(i, j) *= sqrt(S(2 * j + 1) / (2 * i + 1));
  return T;
}

#define HBVM_DEFINE(S)                                             \
  template Matrix<S> legendre_values<S>(const Vector<S>&, int);    \
  template Matrix<S> legendre_integrals<S>(const Vector<S>&, int); \
  template Matrix<S> legendre_integrals<S>(const Matrix<S>&);      \
  template S xi<S>(int);                                           \
  template Matrix<S> X_matrix<S>(int);                             \
  template Matrix<S> legendre_shift<S>(int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
