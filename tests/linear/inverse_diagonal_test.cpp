#include "linear/inverse_diagonal.hpp"

#include "linear/lu.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class InverseDiagonalOf : public InDigits<50> {
 protected:
  RandomValues<S> random{31};
};
TYPED_TEST_SUITE(InverseDiagonalOf, AllScalars, ScalarNames);

/// B^T B for a random band matrix B: symmetric, positive definite, with twice the half bandwidth.
template <class S>
Matrix<S> band_matrix(RandomValues<S>& random, Index n, Index b) {
  Matrix<S> B = Matrix<S>::Zero(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = std::max<Index>(0, j - b); i <= j; ++i) B(i, j) = i == j ? S(3) : random.value();
  Matrix<S> A = Matrix<S>::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index l = 0; l < n; ++l) A(i, j) += B(l, i) * B(l, j);
  return A;
}

TYPED_TEST(InverseDiagonalOf, BandMatricesIsThatOfTheirLu) {
  using S = TypeParam;
  for (const auto& [n, b] : {std::pair<Index, Index>{1, 0}, {2, 1}, {5, 0}, {5, 2}, {6, 5}, {12, 3}}) {
    const Matrix<S> A = band_matrix(this->random, n, b);
    InverseDiagonal<S> diagonal;
    diagonal.resize(n, b);
    Lu<S> lu;
    lu.set(A);
    ASSERT_TRUE(lu.factor());
    for (int again = 0; again < 2; ++again) {
      diagonal.set_zero();
      for (Index j = 0; j < n; ++j)
        for (Index i = j; i <= std::min(n - 1, j + b); ++i) diagonal.entry(i, j) = A(i, j);
      ASSERT_TRUE(diagonal.compute());
      for (Index i = 0; i < n; ++i) {
        Vector<S> x = Vector<S>::Unit(n, i);
        lu.solve(x);
        EXPECT_LE(magnitude(S(diagonal[i] - x[i])), 1000 * epsilon<S>() * magnitude(x[i])) << n << " " << b;
      }
    }
  }
}

TYPED_TEST(InverseDiagonalOf, ASingularOrIndefiniteMatrixIsRefused) {
  using S = TypeParam;
  InverseDiagonal<S> diagonal;
  diagonal.resize(2, 1);
  for (const int corner : {1, 0}) {
    diagonal.set_zero();
    diagonal.entry(0, 0) = diagonal.entry(1, 0) = 1;
    diagonal.entry(1, 1) = corner;
    EXPECT_FALSE(diagonal.compute());
  }
  diagonal.set_zero();
  diagonal.entry(0, 0) = diagonal.entry(1, 1) = S(1) / S(0);
  EXPECT_FALSE(diagonal.compute());
}

}  // namespace
}  // namespace hbvm::core
