#include "scalar/text.hpp"

#include <quadmath.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Correctly rounded readers that are none of ours.
template <Scalar S>
S read(const std::string& text) {
  if constexpr (std::same_as<S, double>) {
    return std::strtod(text.c_str(), nullptr);
  } else if constexpr (std::same_as<S, Quad>) {
    return Quad(strtoflt128(text.c_str(), nullptr));
  } else {
    Mpfr x;
    mpfr_strtofr(raw(x), text.c_str(), nullptr, 10, MPFR_RNDN);
    return x;
  }
}

std::size_t significant_digits(const std::string& text) {
  std::string digits;
  for (const char c : text.substr(0, text.find('e')))
    if (c >= '0' && c <= '9') digits += c;
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  digits.erase(digits.find_last_not_of('0') + 1);
  return digits.size();
}

/// The decimals of `digits` digits next to x on both sides.
template <Scalar S>
std::vector<std::string> decimals_around(const S& x, std::size_t digits) {
  std::vector<std::string> result;
  for (const mpfr_rnd_t towards : {MPFR_RNDD, MPFR_RNDU}) {
    char* text = nullptr;
    mpfr_asprintf(&text, "%.*R*e", static_cast<int>(digits) - 1, towards, raw(exactly(x)));
    result.emplace_back(text);
    mpfr_free_str(text);
  }
  return result;
}

/// A decimal with fewer digits than to_text's that reads back as x; empty if there is none.
template <Scalar S>
std::string shorter_text(const S& x) {
  const std::size_t digits = significant_digits(to_text(x));
  if (digits <= 1) return {};
  for (const std::string& text : decimals_around(x, digits - 1))
    if (read<S>(text) == x) return text;
  return {};
}

template <Scalar S>
void expect_shortest(const S& x) {
  EXPECT_EQ(read<S>(to_text(x)), x) << to_text(x);
  EXPECT_EQ(shorter_text(x), "") << to_text(x);
}

template <class S>
class TextTest : public InDigits<50> {
 protected:
  RandomValues<S> random{5};
};
TYPED_TEST_SUITE(TextTest, AllScalars, ScalarNames);

TYPED_TEST(TextTest, RandomNumbersReadBackFromTheShortestText) {
  for (int trial = 0; trial < 1'000; ++trial)
    expect_shortest(TypeParam(this->random.value() * power_of_two<TypeParam>(this->random.whole(-900, 900))));
}

TYPED_TEST(TextTest, PowersOfTwoReadBackFromTheShortestText) {
  // The numbers below a power of two are twice as dense as those above.
  std::vector<std::string> too_long;
  for (long e = -1'000; e <= 1'000; ++e) {
    const TypeParam x = power_of_two<TypeParam>(e);
    EXPECT_EQ(read<TypeParam>(to_text(x)), x);
    if (!shorter_text(x).empty()) too_long.push_back(to_text(x));
  }
  EXPECT_TRUE(too_long.empty()) << too_long.size() << " of 2001, as " << too_long.front();
}

TYPED_TEST(TextTest, QuotientsAndWholeNumbersReadBackFromTheShortestText) {
  for (int n = 1; n <= 60; ++n) {
    expect_shortest(TypeParam(TypeParam(n) / 60));
    expect_shortest(TypeParam(-n));
  }
}

TYPED_TEST(TextTest, ReadsBackAsALiteral) {
  for (int trial = 0; trial < 200; ++trial) {
    const TypeParam x = this->random.value() * power_of_two<TypeParam>(this->random.whole(-900, 900));
    EXPECT_EQ(literal<TypeParam>(to_text(x)), x);
  }
}

TYPED_TEST(TextTest, SimpleDecimalsStayAsTheyAre) {
  for (const char* text : {"0.1", "-0.3", "1", "-2", "1.5", "120", "0.0001", "1e-5", "1.5e-60", "1234567890123456",
                           "1e16", "1.25e20", "-1e-300"})
    EXPECT_EQ(to_text(literal<TypeParam>(text)), text);
}

TYPED_TEST(TextTest, SpecialValues) {
  using Limits = std::numeric_limits<TypeParam>;
  EXPECT_EQ(to_text(TypeParam(0)), "0");
  EXPECT_EQ(to_text(TypeParam(-TypeParam(0))), "0");
  EXPECT_EQ(to_text(TypeParam(Limits::infinity())), "inf");
  EXPECT_EQ(to_text(TypeParam(-Limits::infinity())), "-inf");
  EXPECT_EQ(to_text(TypeParam(Limits::quiet_NaN())), "nan");
  EXPECT_EQ(to_scientific(TypeParam(-Limits::infinity()), 5), "-inf");
  EXPECT_EQ(to_scientific(TypeParam(Limits::quiet_NaN()), 5), "nan");
}

template <class S>
class BinaryText : public TextTest<S> {};
using BinaryFormats = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(BinaryText, BinaryFormats, ScalarNames);

TYPED_TEST(BinaryText, EndsOfTheRange) {
  using Limits = std::numeric_limits<TypeParam>;
  expect_shortest(TypeParam(Limits::max()));
  expect_shortest(TypeParam(Limits::min()));
}

TYPED_TEST(BinaryText, NumbersBelowTheNormalRangeReadBack) {
  const TypeParam smallest = std::numeric_limits<TypeParam>::denorm_min();
  for (const int n : {1, 2, 3, 5, 1'000, 123'456'789}) {
    const TypeParam x = n * smallest;
    EXPECT_EQ(read<TypeParam>(to_text(x)), x) << to_text(x);
  }
}

TEST(Text, MpfrReadsBackAtEveryPrecision) {
  for (const unsigned digits : {20u, 21u, 34u, 100u, 500u}) {
    const PrecisionScope scope(digits);
    RandomValues<Mpfr> random(digits);
    for (int trial = 0; trial < 50; ++trial) expect_shortest(random.value());
    for (int n = 1; n <= 50; ++n) expect_shortest(Mpfr(Mpfr(n) / 51));
  }
}

TEST(Text, MpfrReachesFarExponents) {
  const PrecisionScope scope(30);
  expect_shortest(literal<Mpfr>("1.5e-30000"));
  EXPECT_EQ(to_text(literal<Mpfr>("1.5e-30000")), "1.5e-30000");
  EXPECT_EQ(to_text(literal<Mpfr>("-7e39000")), "-7e39000");
}

TEST(Scientific, AgreesWithPrintf) {
  RandomValues<double> random(3);
  for (int digits = 1; digits <= 25; ++digits) {
    for (const double x : {random.value(), random.value() * 1e200, random.value() * 1e-200, 0.0, 1.0, -9.9999999999}) {
      char expected[64];
      std::snprintf(expected, sizeof expected, "%.*e", digits - 1, x);
      EXPECT_EQ(to_scientific(x, digits), expected);
    }
  }
}

TEST(Scientific, RoundsInTheNumbersOwnPrecision) {
  const PrecisionScope scope(50);
  EXPECT_EQ(to_scientific(literal<Mpfr>("2/3"), 45), "6.66666666666666666666666666666666666666666667e-01");
  EXPECT_EQ(to_scientific(literal<Quad>("2/3"), 30), "6.66666666666666666666666666667e-01");
  EXPECT_EQ(to_scientific(literal<Mpfr>("1.5e-500"), 3), "1.50e-500");
  EXPECT_EQ(to_scientific(literal<Mpfr>("-9.999"), 2), "-1.0e+01");
  EXPECT_EQ(to_scientific(literal<Mpfr>("123"), 1), "1e+02");
}

TEST(Text, OfADecimalIsRounded) {
  EXPECT_EQ(rounded_text("0.123456", 3), "0.123");
  EXPECT_EQ(rounded_text("0.5", 4), "0.5000");
  EXPECT_EQ(rounded_text("-12.345", 2), "-12");
  EXPECT_EQ(rounded_text("1234567", 3), "1.23e+06");
  EXPECT_EQ(rounded_text("9.99e-700", 1), "1e-699");
  EXPECT_EQ(rounded_text("0", 3), "0");
  EXPECT_EQ(rounded_text("nan", 3), "nan");
  // More digits than the text has are zeros, as many as may be asked for.
  for (const std::size_t zeros : {10U, 20U, 46U, 300U}) {
    EXPECT_EQ(rounded_text("1.2625", 5 + static_cast<int>(zeros)), "1.2625" + std::string(zeros, '0'));
    EXPECT_EQ(to_scientific(std::string("0.7"), static_cast<int>(zeros)), "7." + std::string(zeros - 1, '0') + "e-01");
  }
  const std::string third = "0." + std::string(1'000, '3');
  EXPECT_EQ(rounded_text(third, 1'000), third);
  EXPECT_EQ(to_scientific(std::string("-0.0123456"), 3), "-1.23e-02");
  EXPECT_EQ(to_scientific(std::string("1.5e-9000"), 2), "1.5e-9000");
}

TEST(Text, TellsADecimal) {
  for (const char* text : {"0", "-1.5", ".5", "5.", "1e5", "1.25E-30", "-2.e+7"}) EXPECT_TRUE(is_decimal(text)) << text;
  for (const char* text : {"", "-", ".", "1-2", "1.2.3", "1e", "1e+", "e5", "+1", "nan", "inf", "1/3", "1 ", "0x1"})
    EXPECT_FALSE(is_decimal(text)) << text;
}

}  // namespace
}  // namespace hbvm::core
