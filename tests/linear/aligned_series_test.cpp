#include "linear/aligned_series.hpp"

#include <limits>

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Coefficients of both signs that fall by so many bits each, some of them 0, the first as large as `lead`.
Vector<Mpfr> falling(RandomValues<Mpfr>& random, Index length, double bits, const Mpfr& lead) {
  Vector<Mpfr> a(length);
  for (Index n = 0; n < length; ++n)
    a[n] = n % 5 == 3 ? Mpfr(0) : Mpfr(random.value() * power_of_two<Mpfr>(-static_cast<long>(bits * n)));
  a[0] = lead;
  return a;
}

AlignedSeries aligned(const Vector<Mpfr>& a) {
  AlignedSeries series(a.size());
  for (Index n = 0; n < a.size(); ++n) series.set(n, a[n]);
  return series;
}

/// Comparison the sums with twice the digits: errors of a rounding of the largest factors.
void expect_convolutions(unsigned digits, Index length, double bits, double other_bits, const Mpfr& lead) {
  const PrecisionScope scope(digits);
  RandomValues<Mpfr> random(digits + static_cast<unsigned>(length));
  const Vector<Mpfr> a = falling(random, length, bits, lead), b = falling(random, length, other_bits, Mpfr(1) / 3);
  const AlignedSeries x = aligned(a), y = aligned(b);
  const Mpfr tolerance = 2 * epsilon<Mpfr>() * max_norm(a) * max_norm(b);
  for (Index n = 0; n < length; n += 1 + n / 7)
    for (const Index first : {Index{0}, Index{1}}) {
      const Index last = n - first;
      Mpfr found = 17, exact;
      set_convolution(found, x, y, n, first, last);
      {
        const PrecisionScope more(2 * digits + 10);
        Mpfr sum = 0;
        for (Index i = first; i <= last; ++i) sum += Mpfr(a[i]) * Mpfr(b[n - i]);
        mpfr_set(raw(exact), raw(sum), MPFR_RNDN);
      }
      EXPECT_LE(magnitude(Mpfr(found - exact)), tolerance) << digits << " " << n << " " << first;
    }
}

TEST(AlignedSeries, ConvolutionsAreThoseOfRoundedNumbers) {
  for (const unsigned digits : {20U, 33U, 60U, 120U, 300U, 700U}) {
    expect_convolutions(digits, 70, 3, 3, Mpfr(1));
    expect_convolutions(digits, 40, 0, 11, Mpfr(-1));
    expect_convolutions(digits, 30, 40, 0, Mpfr(1));
    expect_convolutions(digits, 25, 500, 700, Mpfr(1));
  }
}

/// The unit follows the largest, and what is before it stays.
TEST(AlignedSeries, TakesCoefficientsThatGrow) {
  for (const unsigned digits : {30U, 100U})
    for (const char* lead : {"1e-3", "1e-12", "0", "1e40"}) {
      expect_convolutions(digits, 20, 0, 1, Mpfr(lead));
      expect_convolutions(digits, 20, -2, -30, Mpfr(lead));
    }
}

TEST(AlignedSeries, BeginsAnew) {
  const PrecisionScope scope(40);
  AlignedSeries a(3), b(3);
  for (const Mpfr& size : {Mpfr(1), power_of_two<Mpfr>(200), power_of_two<Mpfr>(-200)}) {
    for (Index n = 0; n < 3; ++n) {
      a.set(n, size * (n + 1));
      b.set(n, Mpfr(n + 4));
    }
    Mpfr sum;
    set_convolution(sum, a, b, 2, 0, 2);
    EXPECT_EQ(sum, size * (6 + 10 + 12));
    set_convolution(sum, a, b, 2, 1, 0);
    EXPECT_EQ(sum, 0);
  }
}

/// What is not finite is not lost: it would pass for 0.
TEST(AlignedSeries, ShowsWhatIsNotFinite) {
  const PrecisionScope scope(40);
  for (const double wrong : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    AlignedSeries a(2), b(2);
    a.set(0, Mpfr(1));
    a.set(1, Mpfr(wrong));
    b.set(0, Mpfr(1));
    b.set(1, Mpfr(1));
    Mpfr sum;
    set_convolution(sum, a, b, 1, 0, 1);
    EXPECT_FALSE(is_finite(sum));
    set_convolution(sum, b, a, 1, 0, 1);
    EXPECT_FALSE(is_finite(sum));
    a.set(0, Mpfr(1));
    set_convolution(sum, a, b, 0, 0, 0);
    EXPECT_EQ(sum, 1);
  }
}

}  // namespace
}  // namespace hbvm::core
