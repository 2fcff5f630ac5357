#include "reference/closed_form/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"

namespace hbvm::core {
namespace {

TEST(SymmetricEigen, TakesAMatrixApart) {
  for (const unsigned digits : {20U, 100U, 400U}) {
    const PrecisionScope scope(digits);
    for (Index n = 1; n <= 6; ++n) {
      // Hilbert's matrix with a row and column of zeros, and equal values twice.
      Matrix<Mpfr> a = Matrix<Mpfr>::Zero(n + 3, n + 3);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) a(i, j) = Mpfr(i == j ? 3 : -1) / (i + j + 1);
      a(n + 1, n + 1) = a(n + 2, n + 2) = -7;
      const SymmetricEigen eigen(a);
      const Mpfr tolerance = 1000 * epsilon<Mpfr>();
      for (Index i = 0; i < a.rows(); ++i)
        for (Index j = 0; j < a.rows(); ++j) {
          Mpfr product = 0, unit = 0;
          for (Index l = 0; l < a.rows(); ++l) {
            product += eigen.vectors(i, l) * eigen.values[l] * eigen.vectors(j, l);
            unit += eigen.vectors(l, i) * eigen.vectors(l, j);
          }
          EXPECT_LE(magnitude(Mpfr(product - a(i, j))), tolerance) << i << " " << j;
          EXPECT_LE(magnitude(Mpfr(unit - (i == j ? 1 : 0))), tolerance) << i << " " << j;
        }
    }
  }
}

}  // namespace
}  // namespace hbvm::core
