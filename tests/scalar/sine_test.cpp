#include "scalar/sine.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "scalar/big_float.hpp"

namespace hbvm::core {
namespace {

std::string text_of(mpfr_srcptr a) {
  char* text = nullptr;
  mpfr_asprintf(&text, "%Ra of %ld bits", a, static_cast<long>(mpfr_get_prec(a)));
  std::string result = text;
  mpfr_free_str(text);
  return result;
}

/// Of these bits the sine and the cosine are those of MPFR, and so they are if the result takes the argument's place.
void expect_same_bits(mpfr_srcptr a, mpfr_prec_t precision) {
  BigFloat expected(precision), r(precision), inner(mpfr_get_prec(a));
  const auto same = [](mpfr_srcptr x, mpfr_srcptr y) {
    return (mpfr_nan_p(x) != 0 && mpfr_nan_p(y) != 0) ||
           (mpfr_equal_p(x, y) != 0 && mpfr_signbit(x) == mpfr_signbit(y));
  };
  for (const auto& [ours, theirs] : {std::pair(&set_sin, &mpfr_sin), std::pair(&set_cos, &mpfr_cos)}) {
    theirs(raw(expected), a, MPFR_RNDN);
    ours(raw(r), a, MPFR_RNDN);
    EXPECT_TRUE(same(raw(r), raw(expected))) << (ours == set_sin ? "sin " : "cos ") << text_of(a) << ": "
                                             << text_of(raw(r)) << " instead of " << text_of(raw(expected));
    if (mpfr_get_prec(a) != precision) continue;
    mpfr_set(raw(inner), a, MPFR_RNDN);
    ours(raw(inner), raw(inner), MPFR_RNDN);
    EXPECT_TRUE(same(raw(inner), raw(expected))) << text_of(a);
  }
}

class Sine : public ::testing::Test {
 protected:
  Sine() { gmp_randinit_default(random_); }
  ~Sine() override { gmp_randclear(random_); }
  Sine(const Sine&) = delete;
  Sine& operator=(const Sine&) = delete;

  /// Between -1 and 1 times a power of 2.
  void set_random(mpfr_ptr a, long exponent) {
    mpfr_urandom(a, random_, MPFR_RNDN);
    mpfr_mul_2si(a, a, exponent, MPFR_RNDN);
    if (bits_(engine_) != 0) mpfr_neg(a, a, MPFR_RNDN);
  }
  long pick(long from, long to) { return std::uniform_int_distribution<long>(from, to)(engine_); }

 private:
  gmp_randstate_t random_;
  std::mt19937 engine_{5};
  std::uniform_int_distribution<int> bits_{0, 1};
};

/// At precisions of every number of limbs, full and not.
TEST_F(Sine, HasTheBitsOfMpfr) {
  for (int n = 0; n < 4000; ++n) {
    const mpfr_prec_t precision = n % 10 == 0 ? pick(2, 4000) : pick(60, 700);
    BigFloat a(n % 3 == 0 ? pick(2, 900) : precision);
    set_random(raw(a), n % 2 == 0 ? pick(-1, 6) : pick(-25, 25));
    expect_same_bits(raw(a), precision);
  }
}

/// Where the value is small, and bits cancel.
TEST_F(Sine, HasTheBitsOfMpfrBesideMultiplesOfAQuarterTurn) {
  for (int n = 0; n < 1000; ++n) {
    const mpfr_prec_t precision = pick(60, 500);
    BigFloat a(precision + (n % 2) * 70), beside(precision);
    mpfr_const_pi(raw(a), MPFR_RNDN);
    mpfr_div_2ui(raw(a), raw(a), static_cast<unsigned long>(pick(1, 2)), MPFR_RNDN);
    mpfr_mul_si(raw(a), raw(a), pick(-200'000, 200'000), MPFR_RNDN);
    expect_same_bits(raw(a), precision);
    set_random(raw(beside), -pick(5, 60));
    mpfr_add(raw(a), raw(a), raw(beside), MPFR_RNDN);
    expect_same_bits(raw(a), precision);
  }
}

TEST_F(Sine, LeavesToMpfrWhatItsBallsDoNotDecide) {
  for (const mpfr_prec_t precision : {53L, 333L, 5000L}) {
    BigFloat a(precision);
    mpfr_set_zero(raw(a), -1);
    expect_same_bits(raw(a), precision);
    for (const int sign : {1, -1}) {
      mpfr_set_inf(raw(a), sign);
      expect_same_bits(raw(a), precision);
      for (const long exponent : {-1'000'000L, -400L, -21L, -20L, -19L, 19L, 20L, 21L, 62L, 65L, 400L, 100'000L}) {
        mpfr_set_si_2exp(raw(a), sign, exponent, MPFR_RNDN);
        expect_same_bits(raw(a), precision);
        set_random(raw(a), exponent);
        expect_same_bits(raw(a), precision);
      }
    }
    mpfr_set_nan(raw(a));
    expect_same_bits(raw(a), precision);
  }
}

/// What a diverging iteration reaches; mpfr_sin would compute pi to as many bits as the exponent says.
TEST_F(Sine, IsNoNumberBeyondReach) {
  BigFloat a(100), r(100);
  mpfr_set_si_2exp(raw(a), 1, 131'071, MPFR_RNDN);
  EXPECT_TRUE(has_sine_in_reach(raw(a)));
  expect_same_bits(raw(a), 100);
  for (const long exponent : {131'072L, 1'000'000'000L}) {
    mpfr_set_si_2exp(raw(a), -1, exponent, MPFR_RNDN);
    EXPECT_FALSE(has_sine_in_reach(raw(a)));
    for (const auto set : {&set_sin, &set_cos}) {
      mpfr_set_ui(raw(r), 0, MPFR_RNDN);
      set(raw(r), raw(a), MPFR_RNDN);
      EXPECT_NE(mpfr_nan_p(raw(r)), 0) << exponent;
    }
  }
}

}  // namespace
}  // namespace hbvm::core
