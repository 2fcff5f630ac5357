#include "linear/growing_convolution.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

struct Falls {
  double a, b;      ///< bits by which coefficients fall each; negative if they grow
  Index zeros = 0;  ///< of a, at its beginning
};

Vector<Mpfr> coefficients(RandomValues<Mpfr>& random, Index length, double bits, Index zeros) {
  Vector<Mpfr> x(length);
  for (Index n = 0; n < length; ++n)
    x[n] = n < zeros || n % 7 == 5
               ? Mpfr(0)
               : Mpfr(random.value() * power_of_two<Mpfr>(-static_cast<long>(bits * static_cast<double>(n))));
  return x;
}

/// Coefficient after coefficient, as a recurrence knows them, beside sums in twice the digits.
void expect_sums(unsigned digits, Index length, const Falls& falls, Index from_a, Index from_b, bool square) {
  const PrecisionScope scope(digits);
  RandomValues<Mpfr> random(digits + static_cast<unsigned>(length + from_a));
  GrowingConvolution growing(length, from_a, from_b);
  AlignedSeries x(length), y(length);
  // Twice: the second time another series begins.
  for (int round = 0; round < 2; ++round) {
    const Vector<Mpfr> a = coefficients(random, length, falls.a, falls.zeros),
                       b = square ? a : coefficients(random, length, falls.b, 0);
    Mpfr greatest_a = 0, greatest_b = 0;
    long served = 0;
    for (Index n = 0; n < length; ++n) {
      raise_magnitude(greatest_a, a[n]);
      raise_magnitude(greatest_b, b[n]);
      x.set(n, a[n]);
      // Of a recurrence for b, the coefficient that is not in the sum yet.
      if (n > 0 && from_a == 1) y.set(n - 1, b[n - 1]);
      if (from_a == 0) y.set(n, b[n]);
      if (n < from_a + from_b || !growing.by_blocks(n)) continue;
      ++served;
      Mpfr found = 17, exact;
      growing.set(found, x, square ? x : y, n);
      {
        const PrecisionScope more(2 * digits + 10);
        Mpfr sum = 0;
        for (Index i = from_a; i <= n - from_b; ++i) sum += Mpfr(a[i]) * Mpfr(b[n - i]);
        mpfr_set(raw(exact), raw(sum), MPFR_RNDN);
      }
      const Mpfr tolerance = 2 * epsilon<Mpfr>() * greatest_a * greatest_b;
      ASSERT_LE(magnitude(Mpfr(found - exact)), tolerance) << digits << " " << n << " of " << length;
    }
    if (length > 256) {
      EXPECT_GT(served, 0);
    }
  }
}

TEST(GrowingConvolutionTest, IsTheSumOfProducts) {
  for (const unsigned digits : {30U, 400U})
    for (const Index length : {Index{70}, Index{300}})
      for (const Falls& falls : {Falls{0, 0}, {1.5, 1.5}, {0, 9}, {30, 0}, {-1, -0.5}, {1, 1, 150}}) {
        expect_sums(digits, length, falls, 0, 0, false);
        expect_sums(digits, length, falls, 1, 0, false);
        expect_sums(digits, length, falls, 1, 1, false);
        expect_sums(digits, length, falls, 0, 0, true);
        expect_sums(digits, length, falls, 1, 1, true);
      }
}

/// Where a series has fallen below its unit, its convolutions are small, too: no rounding of larger ones is left there.
TEST(GrowingConvolutionTest, FallsWithItsSeries) {
  const PrecisionScope scope(400);
  RandomValues<Mpfr> random(5);
  const Index length = 600;
  GrowingConvolution growing(length, 0, 0);
  AlignedSeries x(length);
  const Vector<Mpfr> a = coefficients(random, length, 4, 0);
  for (Index n = 0; n < length; ++n) {
    x.set(n, a[n]);
    if (!growing.by_blocks(n)) continue;
    Mpfr found = 0;
    growing.set(found, x, x, n);
    EXPECT_LE(magnitude(found), power_of_two<Mpfr>(16 - std::min(4 * n, Index{1430}))) << n;
  }
}

/// What is no number is not taken for one.
TEST(GrowingConvolutionTest, OfWhatIsNotFiniteIsNotFinite) {
  const PrecisionScope scope(50);
  const Index length = 400;
  AlignedSeries x(length), y(length);
  for (Index n = 0; n < length; ++n) {
    x.set(n, Mpfr(1));
    y.set(n, n == 3 ? Mpfr(std::numeric_limits<double>::infinity()) : Mpfr(1));
  }
  GrowingConvolution growing(length, 0, 0);
  Mpfr found = 0;
  growing.set(found, x, y, length - 1);
  EXPECT_FALSE(is_finite(found));
  growing.set(found, x, x, length - 1);
  EXPECT_EQ(found, length);
}

}  // namespace
}  // namespace hbvm::core
