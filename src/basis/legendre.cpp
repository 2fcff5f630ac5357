#include "hbvm/basis/legendre.hpp"

#include <cmath>

namespace hbvm {

using std::sqrt;

template <Scalar S>
Matrix<S> legendre_values(const Vector<S>& c, int count) {
  Matrix<S> values(c.size(), count);
  for (Index i = 0; i < c.size(); ++i) {
    const S x = 2 * c[i] - 1;
    S previous = 0, value = 1;
    for (int j = 0; j < count; ++j) {
      values(i, j) = value;
      const S next = ((2 * j + 1) * x * value - j * previous) / (j + 1);
      previous = value;
      value = next;
    }
  }
  for (int j = 1; j < count; ++j) {
    const S scale = sqrt(S(2 * j + 1));
    for (Index i = 0; i < c.size(); ++i) values(i, j) *= scale;
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
  const Matrix<S> values = legendre_values<S>(c, count + 1);
  Matrix<S> integrals(c.size(), count);
  for (int j = 0; j < count; ++j) {
    const S above = xi<S>(j + 1), below = xi<S>(j);
    for (Index i = 0; i < c.size(); ++i)
      integrals(i, j) = above * values(i, j + 1) + (j == 0 ? below : S(-below * values(i, j - 1)));
  }
  return integrals;
}

template <Scalar S>
Matrix<S> legendre_shift(int count) {
  // (j + 1) L_{j+1} = (2 j + 1) x L_j - j L_{j-1} at x = 2 c + 1 = (2 c - 1) + 2, where (2 c - 1) L_i is
  // ((i + 1) L_{i+1} + i L_{i-1}) / (2 i + 1), for polynomials L with L(1) = 1.
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
  template S xi<S>(int);                                           \
  template Matrix<S> X_matrix<S>(int);                             \
  template Matrix<S> legendre_shift<S>(int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
