#include "linear/mpfr_dot.hpp"

#include <random>

#include "printing.hpp"

namespace hbvm::core {
namespace {

/// The exact sum of products, in as many bits as it takes.
class Exact {
 public:
  Exact() { mpfr_init2(sum_, 60'000), mpfr_init2(product_, 60'000), mpfr_set_zero(sum_, 1); }
  ~Exact() { mpfr_clears(sum_, product_, nullptr); }
  void add(const Mpfr& x, const Mpfr& y) {
    mpfr_mul(product_, raw(x), raw(y), MPFR_RNDN);
    mpfr_add(sum_, sum_, product_, MPFR_RNDN);
  }
  mpfr_srcptr sum() const { return sum_; }

 private:
  mpfr_t sum_, product_;
};

/// |r - exact| is half a unit of r's last place, plus n units of the limb below that of the largest product.
void expect_rounded(const Mpfr& r, const Exact& exact, mpfr_exp_t largest, long n) {
  mpfr_t error, bound, part;
  mpfr_inits2(200, error, bound, part, nullptr);
  mpfr_sub(error, raw(r), exact.sum(), MPFR_RNDA);
  mpfr_abs(error, error, MPFR_RNDA);
  const long bits = mpfr_get_prec(raw(r)), limbs = (bits + 63) / 64;
  mpfr_set_ui_2exp(bound, static_cast<unsigned long>(n), largest - 64 * (limbs + 1), MPFR_RNDU);
  if (!mpfr_zero_p(raw(r))) {
    mpfr_set_ui_2exp(part, 1, mpfr_get_exp(raw(r)) - bits - 1, MPFR_RNDU);
    mpfr_add(bound, bound, part, MPFR_RNDU);
  }
  EXPECT_LE(mpfr_cmp(error, bound), 0) << r;
  mpfr_clears(error, bound, part, nullptr);
}

class MpfrDot : public ::testing::TestWithParam<unsigned> {
 protected:
  PrecisionScope digits{GetParam()};
  std::mt19937_64 random{7};

  /// Sign, exponent within +-spread, and all digits at random; 0 now and then.
  Mpfr number(int spread) {
    Mpfr x = 0;
    if (random() % 17 == 0) return x;
    for (int i = 0; i < 14; ++i) x = (x + Mpfr(static_cast<unsigned long>(random() >> 1))) / Mpfr(1UL << 62);
    x = ldexp(x, static_cast<int>(random() % static_cast<unsigned>(2 * spread + 1)) - spread);
    return random() % 2 == 0 ? x : Mpfr(-x);
  }
};

TEST_P(MpfrDot, IsTheExactSumRoundedOnce) {
  for (const int spread : {0, 3, 70, 300, 5000}) {
    for (const long n : {1, 2, 3, 8, 30}) {
      for (int trial = 0; trial < 20; ++trial) {
        std::vector<Mpfr> x, y;
        Exact exact;
        mpfr_exp_t largest = -100'000;
        for (long i = 0; i < n; ++i) {
          x.push_back(number(spread));
          for (int gap = 0; gap < 2; ++gap) x.push_back(Mpfr(77));
          y.push_back(number(spread));
          // Sums that cancel but for round-off, and some that do so exactly.
          if (i % 2 == 1 && trial % 2 == 0) {
            x[static_cast<std::size_t>(3 * i)] = x[static_cast<std::size_t>(3 * (i - 1))];
            y[static_cast<std::size_t>(i)] = -y[static_cast<std::size_t>(i - 1)];
            if (trial % 4 == 0) y[static_cast<std::size_t>(i)] *= 1 + epsilon<Mpfr>();
          }
          const Mpfr &a = x[static_cast<std::size_t>(3 * i)], &b = y[static_cast<std::size_t>(i)];
          exact.add(a, b);
          if (a != 0 && b != 0) largest = std::max(largest, mpfr_get_exp(raw(a)) + mpfr_get_exp(raw(b)));
        }
        Mpfr r = 5;
        ASSERT_TRUE(dot(raw(r), x.data(), 3, y.data(), 1, n));
        expect_rounded(r, exact, largest, n);
      }
    }
  }
}

TEST_P(MpfrDot, OfZerosIsZero) {
  const std::vector<Mpfr> x{Mpfr(0), Mpfr(3)}, y{Mpfr(2), Mpfr(0)};
  Mpfr r = 5;
  ASSERT_TRUE(dot(raw(r), x.data(), 1, y.data(), 1, 2));
  EXPECT_EQ(r, 0);
  ASSERT_TRUE(dot(raw(r), x.data(), 1, y.data(), 1, 0));
  EXPECT_EQ(r, 0);
}

TEST_P(MpfrDot, LeavesWhatIsNotFiniteToTheLoop) {
  Mpfr nan = 0, infinite = 1, r = 5;
  mpfr_set_nan(raw(nan));
  mpfr_set_inf(raw(infinite), 1);
  for (const Mpfr& bad : {nan, infinite}) {
    const std::vector<Mpfr> x{Mpfr(1), bad}, y{Mpfr(2), Mpfr(3)};
    EXPECT_FALSE(dot(raw(r), x.data(), 1, y.data(), 1, 2));
    EXPECT_EQ(r, 5);
  }
}

INSTANTIATE_TEST_SUITE_P(Digits, MpfrDot, ::testing::Values(15U, 20U, 34U, 50U, 57U, 100U, 308U));

TEST(LongMpfrDot, IsNotForVeryLongNumbers) {
  const PrecisionScope digits(1000);
  const std::vector<Mpfr> x{Mpfr(1)};
  Mpfr r = 5;
  EXPECT_FALSE(dot(raw(r), x.data(), 1, x.data(), 1, 1));
}

TEST(LongMpfrDot, IsNotForNumbersOfUnequalLength) {
  std::vector<Mpfr> x;
  {
    const PrecisionScope digits(60);
    x.push_back(Mpfr(1));
  }
  const PrecisionScope digits(30);
  Mpfr r = 5;
  EXPECT_FALSE(dot(raw(r), x.data(), 1, x.data(), 1, 1));
}

}  // namespace
}  // namespace hbvm::core
