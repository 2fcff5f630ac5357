#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// c = a b, for a (n x l) and b (l x m); c is resized. Column by column, as a b applies one small coefficient
/// matrix (n stages, l Fourier coefficients) to each of m coordinates.
template <Scalar S>
void product(Matrix<S>& c, const Matrix<S>& a, const Matrix<S>& b);

/// The same in double for an `a` of so few entries that they stay in registers, without a look at sizes.
/// \param plus null, or plus[j] is added to the entries of column j
template <Index rows, Index terms>
[[gnu::always_inline]] inline void multiply_few(double* __restrict c, const double* __restrict a,
                                                const double* __restrict b, Index columns,
                                                const double* __restrict plus = nullptr) {
  double factors[rows * terms];
  for (Index i = 0; i < rows * terms; ++i) factors[i] = a[i];
#pragma GCC ivdep
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) {
      double sum = factors[i] * b[j * terms];
      for (Index l = 1; l < terms; ++l) sum += factors[i + l * rows] * b[l + j * terms];
      c[i + j * rows] = plus ? sum + plus[j] : sum;
    }
}

/// r = a x, for an x whose entries stand at x[l * x_stride]. r is neither a nor x.
template <Scalar S>
void set_times(S* r, const Matrix<S>& a, const S* x, Index x_stride);

/// sum_i a_i b_i.
template <Scalar S>
S dot(const Vector<S>& a, const Vector<S>& b);

/// r = sum_i x_i y_i for i < n, where x_i stands at x[i * x_stride], rounded about once. What is lost of products and
/// sums is summed, too, and added at the end (Ogita, Rump and Oishi 2005, Dot2). In quad, where an exact product is
/// software upon software, every product and sum is rounded. r is none of them.
template <Scalar S>
void set_dot(S& r, const S* x, Index x_stride, const S* y, Index y_stride, Index n);

}  // namespace hbvm::core
