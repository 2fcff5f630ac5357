#include "linear/aligned_matrix.hpp"

#include "linear/product.hpp"
#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Numbers of both signs, some 0, from 1 down to 2^-spread.
Matrix<Mpfr> some(RandomValues<Mpfr>& random, Index rows, Index columns, long spread) {
  Matrix<Mpfr> a(rows, columns);
  for (Index i = 0; i < a.size(); ++i)
    a.data()[i] = i % 7 == 3 ? Mpfr(0) : Mpfr(random.value() * power_of_two<Mpfr>(-(i * 37 % (spread + 1))));
  return a;
}

/// Comparison the sums with twice the digits; errors beside the largest products, which is what both are good for.
void expect_products(unsigned digits, Index rows, Index columns, Index stride, long spread) {
  const PrecisionScope scope(digits);
  RandomValues<Mpfr> random(static_cast<unsigned>(digits + rows));
  const Matrix<Mpfr> a = some(random, rows, columns, spread), x = some(random, columns * stride, 1, spread);
  AlignedMatrix aligned(a);
  Vector<Mpfr> r = Vector<Mpfr>::Constant(rows, Mpfr(5));
  ASSERT_TRUE(aligned.times(r.data(), x.data(), stride));
  const Mpfr tolerance = (1 + Mpfr(columns) / 1024) * epsilon<Mpfr>() * max_norm(a) * max_norm(x) * columns;
  for (Index i = 0; i < rows; ++i) {
    const PrecisionScope more(2 * digits + 10);
    Mpfr sum = 0;
    for (Index l = 0; l < columns; ++l) sum += a(i, l) * x.data()[l * stride];
    EXPECT_LE(magnitude(Mpfr(r[i] - sum)), tolerance) << digits << ": " << rows << " x " << columns << ", row " << i;
  }
}

TEST(AlignedMatrix, MultipliesWithOneRounding) {
  for (const unsigned digits : {20U, 36U, 37U, 38U, 39U, 60U, 73U, 77U, 100U, 400U})
    for (const long spread : {0L, 5L, 64L, 130L, 3000L})
      for (const Index stride : {1, 2}) {
        expect_products(digits, 5, 9, stride, spread);
        expect_products(digits, 1, 1, stride, spread);
        expect_products(digits, 12, 40, stride, spread);
      }
}

/// A sum of one product keeps all its digits, whatever its size and sign, and sums that cancel are 0.
TEST(AlignedMatrix, KeepsTheDigitsOfTheLargest) {
  const PrecisionScope digits(50);
  Matrix<Mpfr> a(1, 2);
  a << Mpfr(1) / 3, Mpfr(-1) / 3;
  AlignedMatrix aligned(a);
  for (const long exponent : {-1000L, 0L, 1000L}) {
    Vector<Mpfr> x(2), r(1);
    x << power_of_two<Mpfr>(exponent), Mpfr(0);
    ASSERT_TRUE(aligned.times(r.data(), x.data(), 1));
    EXPECT_EQ(r[0], Mpfr(a(0, 0) * x[0]));
    x[1] = x[0];
    ASSERT_TRUE(aligned.times(r.data(), x.data(), 1));
    EXPECT_EQ(r[0], 0);
  }
  const Vector<Mpfr> zero = Vector<Mpfr>::Zero(2);
  Vector<Mpfr> r = Vector<Mpfr>::Constant(1, Mpfr(3));
  ASSERT_TRUE(aligned.times(r.data(), zero.data(), 1));
  EXPECT_EQ(r[0], 0);
}

TEST(AlignedMatrix, SaysWhereItDoesNotApply) {
  const PrecisionScope digits(50);
  AlignedMatrix aligned(Matrix<Mpfr>::Constant(2, 2, Mpfr(3)));
  Vector<Mpfr> x = Vector<Mpfr>::Constant(2, Mpfr(1)), r = Vector<Mpfr>::Constant(2, Mpfr(7));
  x[1] = std::numeric_limits<Mpfr>::infinity();
  EXPECT_FALSE(aligned.times(r.data(), x.data(), 1));
  EXPECT_EQ(r[0], 7);
  {
    const PrecisionScope other(60);
    const Vector<Mpfr> longer = Vector<Mpfr>::Constant(2, Mpfr(1));
    EXPECT_FALSE(aligned.times(r.data(), longer.data(), 1));
  }
  EXPECT_FALSE(AlignedMatrix().times(r.data(), x.data(), 1));
  const PrecisionScope many(1000);
  const Vector<Mpfr> y = Vector<Mpfr>::Constant(2, Mpfr(1));
  EXPECT_FALSE(AlignedMatrix(Matrix<Mpfr>::Constant(2, 2, Mpfr(3))).times(r.data(), y.data(), 1));
}

}  // namespace
}  // namespace hbvm::core
