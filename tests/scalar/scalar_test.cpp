#include "scalar/scalar.hpp"

#include <cmath>
#include <vector>

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
struct Range {
  static constexpr long smallest = -100'000, largest = 100'000;  // exponents e of numbers in [1/2, 1) 2^e
};
template <>
struct Range<double> {
  static constexpr long smallest = -1'073, largest = 1'024;
};
template <>
struct Range<Quad> {
  static constexpr long smallest = -16'493, largest = 16'384;
};

template <class S>
class ScalarTest : public InDigits<50> {
 protected:
  RandomValues<S> random{11};
  const int bits = significand_bits<S>();

  /// A positive number with `bits` random significand bits and exponent `e`.
  BigFloat random_number(long e) {
    BigFloat x(bits);
    do x = exactly(S(magnitude(random.value())));
    while (mpfr_zero_p(raw(x)) != 0);
    mpfr_set_exp(raw(x), e);
    return x;
  }
};
TYPED_TEST_SUITE(ScalarTest, AllScalars, ScalarNames);

/// x + quarters/4 ulp + tail, where an ulp is that of `bits` bits and the tail far smaller.
BigFloat beyond(const BigFloat& x, long quarters, long tail) {
  const long bits = mpfr_get_prec(raw(x));
  const long ulp = mpfr_get_exp(raw(x)) - bits;
  BigFloat result(2 * bits + 100), part(64);
  mpfr_set_si_2exp(raw(part), quarters, ulp - 2, MPFR_RNDN);
  mpfr_add(raw(result), raw(x), raw(part), MPFR_RNDN);
  mpfr_set_si_2exp(raw(part), tail, ulp - bits, MPFR_RNDN);
  mpfr_add(raw(result), raw(result), raw(part), MPFR_RNDN);
  return result;
}

bool last_bit_is_set(const BigFloat& x) {
  BigFloat shorter(mpfr_get_prec(raw(x)) - 1);
  return mpfr_set(raw(shorter), raw(x), MPFR_RNDZ) != 0;
}

TYPED_TEST(ScalarTest, EpsilonIsTheDistanceFromOneToTheNextNumber) {
  const TypeParam one = 1, eps = epsilon<TypeParam>();
  BigFloat next = exactly(one);
  mpfr_nextabove(raw(next));
  EXPECT_EQ(one + eps, rounded_to<TypeParam>(raw(next)));
  EXPECT_EQ(one + eps / 2, one);
  EXPECT_EQ(mpfr_get_prec(raw(exactly(one))), this->bits);
}

TYPED_TEST(ScalarTest, DigitsFitIntoTheSignificand) {
  EXPECT_GE(std::pow(2.0, this->bits - 1), std::pow(10.0, digits10<TypeParam>()));
}

TEST(Scalar, DigitsAndBits) {
  EXPECT_EQ(digits10<double>(), 15);
  EXPECT_EQ(digits10<Quad>(), 33);
  EXPECT_EQ(significand_bits<double>(), 53);
  EXPECT_EQ(significand_bits<Quad>(), 113);
  for (const int digits : {20, 50, 1'000}) {
    const PrecisionScope scope(static_cast<unsigned>(digits));
    EXPECT_EQ(digits10<Mpfr>(), digits);
    EXPECT_EQ(significand_bits<Mpfr>(), mpfr_get_prec(raw(Mpfr(1))));
  }
}

TYPED_TEST(ScalarTest, ExactlyAndBackIsTheIdentity) {
  for (int trial = 0; trial < 300; ++trial) {
    const long e = this->random.whole(Range<TypeParam>::smallest, Range<TypeParam>::largest);
    const TypeParam x = rounded_to<TypeParam>(raw(this->random_number(e)));
    for (const TypeParam& y : {x, TypeParam(-x)}) {
      const BigFloat exact = exactly(y);
      EXPECT_LE(mpfr_get_prec(raw(exact)), this->bits);
      EXPECT_EQ(rounded_to<TypeParam>(raw(exact)), y);
    }
  }
}

TYPED_TEST(ScalarTest, ExactlyIsExact) {
  using std::ldexp;
  for (int trial = 0; trial < 50; ++trial) {
    TypeParam rest = magnitude(this->random.value());
    const BigFloat exact = exactly(rest);
    BigFloat rebuilt(4 * this->bits), limb(64);
    mpfr_set_zero(raw(rebuilt), 1);
    for (long shift = 30; rest != 0; shift += 30) {
      rest = ldexp(rest, 30);
      const long head = static_cast<long>(rest);
      rest -= head;
      mpfr_set_si_2exp(raw(limb), head, -shift, MPFR_RNDN);
      mpfr_add(raw(rebuilt), raw(rebuilt), raw(limb), MPFR_RNDN);
    }
    EXPECT_TRUE(mpfr_equal_p(raw(exact), raw(rebuilt)));
  }
}

TYPED_TEST(ScalarTest, SpecialValuesSurvive) {
  BigFloat x(200);
  mpfr_set_inf(raw(x), -1);
  const TypeParam minus_infinity = rounded_to<TypeParam>(raw(x));
  EXPECT_LT(minus_infinity, 0);
  EXPECT_FALSE(is_finite(minus_infinity));
  EXPECT_NE(mpfr_inf_p(raw(exactly(minus_infinity))), 0);
  EXPECT_LT(mpfr_sgn(raw(exactly(minus_infinity))), 0);

  mpfr_set_nan(raw(x));
  const TypeParam nan = rounded_to<TypeParam>(raw(x));
  EXPECT_FALSE(nan == nan);
  EXPECT_FALSE(is_finite(nan));
  EXPECT_NE(mpfr_nan_p(raw(exactly(nan))), 0);

  for (const int sign : {1, -1}) {
    mpfr_set_zero(raw(x), sign);
    const TypeParam zero = rounded_to<TypeParam>(raw(x));
    EXPECT_EQ(zero, 0);
    EXPECT_EQ(mpfr_signbit(raw(exactly(zero))) != 0, sign < 0);
  }
}

TYPED_TEST(ScalarTest, RoundsToTheNearestAndTiesToEven) {
  for (int trial = 0; trial < 300; ++trial) {
    const BigFloat low =
        this->random_number(this->random.whole(Range<TypeParam>::smallest + this->bits, Range<TypeParam>::largest - 1));
    BigFloat high = low;
    mpfr_nextabove(raw(high));
    const TypeParam below = rounded_to<TypeParam>(raw(low)), above = rounded_to<TypeParam>(raw(high));
    ASSERT_LT(below, above);
    EXPECT_EQ(rounded_to<TypeParam>(raw(beyond(low, 1, 0))), below);
    EXPECT_EQ(rounded_to<TypeParam>(raw(beyond(low, 2, -1))), below);
    EXPECT_EQ(rounded_to<TypeParam>(raw(beyond(low, 2, 0))), last_bit_is_set(low) ? above : below);
    EXPECT_EQ(rounded_to<TypeParam>(raw(beyond(low, 2, 1))), above);
    EXPECT_EQ(rounded_to<TypeParam>(raw(beyond(low, 3, 0))), above);
  }
}

template <class S>
class BinaryFormat : public ::testing::Test {};
using BinaryFormats = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(BinaryFormat, BinaryFormats, ScalarNames);

TYPED_TEST(BinaryFormat, ReachesBothEndsOfTheRange) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam& x : {Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min()})
    EXPECT_EQ(rounded_to<TypeParam>(raw(exactly(x))), x);
  BigFloat smallest(10), largest(10);
  mpfr_set_ui_2exp(raw(smallest), 1, Range<TypeParam>::smallest - 1, MPFR_RNDN);
  EXPECT_EQ(rounded_to<TypeParam>(raw(smallest)), Limits::denorm_min());
  mpfr_set_ui_2exp(raw(largest), 1, Range<TypeParam>::largest, MPFR_RNDN);
  EXPECT_EQ(rounded_to<TypeParam>(raw(largest)), Limits::infinity());
}

TYPED_TEST(BinaryFormat, RoundsNumbersBelowTheNormalRangeOnce) {
  const TypeParam smallest = std::numeric_limits<TypeParam>::denorm_min();
  const long e = Range<TypeParam>::smallest - 1;
  const auto rounded = [&](long halves, long tail_exponent) {
    BigFloat x(500), tail(10);
    mpfr_set_si_2exp(raw(x), halves, e - 1, MPFR_RNDN);
    mpfr_set_si_2exp(raw(tail), tail_exponent < 0 ? -1 : 1, e - std::labs(tail_exponent), MPFR_RNDN);
    mpfr_add(raw(x), raw(x), raw(tail), MPFR_RNDN);
    return rounded_to<TypeParam>(raw(x));
  };
  EXPECT_EQ(rounded(1, 200), smallest);
  EXPECT_EQ(rounded(1, -200), 0);
  EXPECT_EQ(rounded(5, 200), 3 * smallest);
  EXPECT_EQ(rounded(5, -200), 2 * smallest);
  EXPECT_EQ(rounded(7, -200), 3 * smallest);
  BigFloat half(2);
  mpfr_set_si_2exp(raw(half), 1, e - 1, MPFR_RNDN);
  EXPECT_EQ(rounded_to<TypeParam>(raw(half)), 0);
}

TYPED_TEST(ScalarTest, NormsDoNotHideNaN) {
  const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  TypeParam bound = 1;
  raise_to(bound, TypeParam(0));
  EXPECT_EQ(bound, 1);
  raise_to(bound, TypeParam(3));
  EXPECT_EQ(bound, 3);
  raise_to(bound, nan);
  EXPECT_NE(bound, bound);
}

TYPED_TEST(ScalarTest, MagnitudeDropsTheSign) {
  const TypeParam x = this->random.value();
  EXPECT_EQ(magnitude(x), magnitude(TypeParam(-x)));
  EXPECT_EQ(magnitude(x) * magnitude(x), x * x);
  EXPECT_GE(magnitude(x), 0);
}

TYPED_TEST(ScalarTest, ApproximatelyIsTheNextDouble) {
  const TypeParam third = TypeParam(1) / 3;
  EXPECT_EQ(approximately(third), 1.0 / 3);
}

}  // namespace
}  // namespace hbvm::core
