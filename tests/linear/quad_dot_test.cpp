#include "linear/quad_dot.hpp"

#include <limits>

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

#if HBVM_QUAD

namespace hbvm::core {
namespace {

/// n numbers of exponents within +-spread, `stride` apart; every seventh is 0. What is between is not to be read.
std::vector<Quad> numbers(RandomValues<Quad>& random, long n, long stride, long spread) {
  std::vector<Quad> x(static_cast<std::size_t>(n * stride), std::numeric_limits<Quad>::quiet_NaN());
  for (long i = 0; i < n; ++i)
    x[static_cast<std::size_t>(i * stride)] =
        random.whole(0, 6) == 0 ? Quad(0) : ldexp(random.value(), static_cast<int>(random.whole(-spread, spread)));
  return x;
}

TEST(QuadDot, IsTheExactSumRoundedOnce) {
  RandomValues<Quad> random(3);
  for (const long spread : {0L, 3L, 60L, 500L})
    for (const long n : {1L, 2L, 3L, 12L, 256L})
      for (int trial = 0; trial < 30; ++trial) {
        std::vector<Quad> x = numbers(random, n, 3, spread), y = numbers(random, n, 2, spread);
        // Sums that cancel but for round-off, and some that do so exactly.
        for (std::size_t i = 1; trial % 2 == 0 && i < static_cast<std::size_t>(n); i += 2) {
          x[3 * i] = x[3 * (i - 1)];
          y[2 * i] = -y[2 * (i - 1)];
          if (trial % 4 == 0) y[2 * i] = y[2 * i] * (1 + epsilon<Quad>());
        }
        BigFloat sum(4000), product(226), error(4000);
        mpfr_set_zero(raw(sum), 1);
        long greatest = std::numeric_limits<long>::min() / 2;
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
          const Quad &a = x[3 * i], &b = y[2 * i];
          mpfr_mul(raw(product), raw(exactly(a)), raw(exactly(b)), MPFR_RNDN);
          mpfr_add(raw(sum), raw(sum), raw(product), MPFR_RNDN);
          if (a != 0 && b != 0) greatest = std::max(greatest, binary_exponent(a) + binary_exponent(b));
        }
        Quad r = 5;
        ASSERT_TRUE(dot(r, x.data(), 3, y.data(), 2, n));
        if (greatest < -100'000) {
          EXPECT_EQ(r, 0);
          continue;
        }
        mpfr_sub(raw(error), raw(sum), raw(exactly(r)), MPFR_RNDN);
        BigFloat bound(100), unit(100);
        mpfr_set_ui_2exp(raw(bound), static_cast<unsigned long>(n), greatest - 183, MPFR_RNDU);
        if (r != 0) {
          mpfr_set_ui_2exp(raw(unit), 1, binary_exponent(r) - 114, MPFR_RNDU);
          mpfr_add(raw(bound), raw(bound), raw(unit), MPFR_RNDU);
        }
        ASSERT_LE(mpfr_cmpabs(raw(error), raw(bound)), 0) << r << ", n = " << n << ", spread " << spread;
      }
}

/// Their rounding errors would not be those of one rounding, or there would be none.
TEST(QuadDot, LeavesWhatIsNotNormalToOthers) {
  using Limits = std::numeric_limits<Quad>;
  const auto applies = [](const Quad& a, const Quad& b) {
    const Quad x[] = {1, a}, y[] = {2, b};
    Quad r = 7;
    const bool result = dot(r, x, 1, y, 1, 2);
    EXPECT_TRUE(result || r == 7);
    return result;
  };
  EXPECT_TRUE(applies(1, 0));
  EXPECT_TRUE(applies((Limits::min)(), 0));
  EXPECT_FALSE(applies((Limits::min)() / 2, 0));
  EXPECT_FALSE(applies(0, Limits::infinity()));
  EXPECT_FALSE(applies(Limits::quiet_NaN(), 1));
  EXPECT_FALSE(applies((Limits::max)(), 1));
  const Quad tiny[] = {ldexp(Quad(1), -16'300)}, one[] = {1}, zero[] = {0};
  Quad r = 7;
  EXPECT_FALSE(dot(r, tiny, 1, one, 1, 1));
  EXPECT_TRUE(dot(r, zero, 1, one, 1, 1));
  EXPECT_EQ(r, 0);
  const std::vector<Quad> many(257, Quad(1));
  EXPECT_FALSE(dot(r, many.data(), 1, many.data(), 1, 257));
  EXPECT_TRUE(dot(r, many.data(), 1, many.data(), 1, 256));
  EXPECT_EQ(r, 256);
  EXPECT_TRUE(dot(r, many.data(), 1, many.data(), 1, 0));
  EXPECT_EQ(r, 0);
}

}  // namespace
}  // namespace hbvm::core

#endif
