#include "linear/dense_lu.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "linear/matrix.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Column by column, without blocks: the textbook's elimination, with whole rows exchanged.
bool factor_plainly(Matrix<double>& a, std::vector<Index>& pivots) {
  const Index n = a.rows();
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    pivots[static_cast<std::size_t>(k)] = pivot;
    if (a(pivot, k) == 0 || !std::isfinite(a(pivot, k))) return false;
    for (Index j = 0; j < n; ++j) std::swap(a(k, j), a(pivot, j));
    for (Index i = k + 1; i < n; ++i) {
      a(i, k) /= a(k, k);
      for (Index j = k + 1; j < n; ++j) a(i, j) -= a(i, k) * a(k, j);
    }
  }
  return true;
}

/// Bit for bit, whatever part of a block and of a register is left over.
TEST(DenseLu, HasTheFactorsOfEliminationWithoutBlocks) {
  RandomValues<double> random(5);
  for (const Index n : {1, 2, 7, 8, 9, 31, 32, 33, 41, 64, 75, 100, 131}) {
    Matrix<double> a = random.matrix(n, n), b = a;
    std::vector<Index> pivots(static_cast<std::size_t>(n)), expected = pivots;
    ASSERT_TRUE(factor_dense(a.data(), n, pivots)) << n;
    ASSERT_TRUE(factor_plainly(b, expected)) << n;
    EXPECT_EQ(pivots, expected) << n;
    EXPECT_EQ(a, b) << n;
  }
}

TEST(DenseLu, FindsSingularMatrices) {
  RandomValues<double> random(6);
  for (const Index column : {0, 40, 69}) {
    Matrix<double> a = random.matrix(70, 70);
    std::vector<Index> pivots(70);
    a.col(column).setZero();
    EXPECT_FALSE(factor_dense(a.data(), 70, pivots)) << column;
    a = random.matrix(70, 70);
    a.col(column).setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(factor_dense(a.data(), 70, pivots)) << column;
  }
}

}  // namespace
}  // namespace hbvm::core
