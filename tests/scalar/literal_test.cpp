#include "scalar/literal.hpp"

#include <cmath>
#include <cstdlib>

#include "printing.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
std::string refusal(const std::string& text, const Constants& constants = {}) {
  return message_of<ExpressionError>([&] { evaluate<S>(Expression::parse(text), constants); });
}

Constants constants(std::initializer_list<std::pair<const char*, std::string>> entries) {
  Constants result;
  for (const auto& [name, text] : entries) result.emplace(name, Expression::parse(text));
  return result;
}

template <class S>
class Literal : public InDigits<50> {};
TYPED_TEST_SUITE(Literal, AllScalars, ScalarNames);

TYPED_TEST(Literal, IsRoundedToNearest) {
  const TypeParam tenth = literal<TypeParam>("0.1");
  BigFloat error(1'000);
  mpfr_mul_ui(raw(error), raw(exactly(tenth)), 10, MPFR_RNDN);
  mpfr_sub_ui(raw(error), raw(error), 1, MPFR_RNDN);
  EXPECT_FALSE(mpfr_zero_p(raw(error)));
  // 0.1 lies in [1/16, 1/8): half an ulp is 2^(-4 - bits), and ten times it below 2^-bits.
  BigFloat bound(2);
  mpfr_set_ui_2exp(raw(bound), 10, -4 - significand_bits<TypeParam>(), MPFR_RNDN);
  EXPECT_LE(mpfr_cmpabs(raw(error), raw(bound)), 0);
}

TEST(DoubleLiteral, AgreesWithTheCompiler) {
  EXPECT_EQ(literal<double>("0.1"), 0.1);
  EXPECT_EQ(literal<double>("1e23"), 1e23);
  EXPECT_EQ(literal<double>("9007199254740993"), 9007199254740993.0);
  EXPECT_EQ(literal<double>("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(literal<double>("2.2250738585072014e-308"), 2.2250738585072014e-308);
}

TYPED_TEST(Literal, UsesConstants) {
  const Constants known = constants({{"a", "1/2"}, {"b", "a+a*a"}, {"c", "2*b-a"}});
  EXPECT_EQ(evaluate<TypeParam>(Expression::parse("c*8"), known), 8);
  EXPECT_EQ(evaluate<TypeParam>(Expression::parse("a-a"), known), 0);
}

TYPED_TEST(Literal, ConstantsAreNotRounded) {
  const Constants known = constants({{"root", "sqrt(2)"}, {"third", "1/3"}});
  EXPECT_EQ(evaluate<TypeParam>(Expression::parse("root*root"), known), 2);
  EXPECT_EQ(evaluate<TypeParam>(Expression::parse("1-third-third-third"), known), 0);
}

TYPED_TEST(Literal, UnknownNamesAreNamed) {
  EXPECT_NE(refusal<TypeParam>("2*height").find("unknown name 'height'"), std::string::npos);
  const Constants known = constants({{"a", "2*hidden"}});
  EXPECT_NE(refusal<TypeParam>("a", known).find("unknown name 'hidden'"), std::string::npos);
}

TYPED_TEST(Literal, ConstantsMustNotFormACycle) {
  EXPECT_NE(refusal<TypeParam>("a", constants({{"a", "a"}})).find("defined by itself"), std::string::npos);
  EXPECT_NE(refusal<TypeParam>("a", constants({{"a", "b"}, {"b", "1+c"}, {"c", "2*a"}})).find("defined by itself"),
            std::string::npos);
  EXPECT_NE(refusal<TypeParam>("a", constants({{"a", "a-a"}})), "");
}

TYPED_TEST(Literal, MayUseAConstantManyTimes) {
  Constants known = constants({{"x0", "1"}});
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "x" + std::to_string(i - 1);
    known.emplace("x" + std::to_string(i), Expression::parse(before + "+" + before));
  }
  EXPECT_EQ(evaluate<TypeParam>(Expression::parse("x60"), known), TypeParam(1L << 60));
}

Constants chain(int length, int operations) {
  Constants known = constants({{"x0", "1"}});
  for (int i = 1; i < length; ++i) {
    std::string text = "x" + std::to_string(i - 1);
    for (int j = 0; j < operations; ++j) text += "+1";
    known.emplace("x" + std::to_string(i), Expression::parse(text));
  }
  return known;
}

TEST(ConstantChain, OfMoreThanAHundredIsAnError) {
  EXPECT_EQ(evaluate<double>(Expression::parse("x99"), chain(100, 1)), 100);
  EXPECT_NE(refusal<double>("x100000", chain(100'001, 1)).find("too deeply"), std::string::npos);
}

TEST(ConstantChainDeathTest, OfLongExpressionsHasAValueOrAnErrorAndNoCrash) {
  const Constants known = chain(100, 490);
  const Expression last = Expression::parse("x99");
  EXPECT_EXIT(
      {
        try {
          evaluate<double>(last, known);
        } catch (const ExpressionError&) {
        }
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(DoubleLiteral, OverflowAndUnderflowAreErrors) {
  for (const char* text : {"1e309", "-1e309", "2^1024", "1e-325", "-1e-400", "2^-1100", "exp(1000)", "exp(-1000)"})
    EXPECT_NE(refusal<double>(text).find("outside the range"), std::string::npos) << text;
  EXPECT_EQ(literal<double>("2^1023"), 0x1p1023);
  EXPECT_EQ(literal<double>("2^-1074"), 0x1p-1074);
}

TEST(QuadLiteral, OverflowAndUnderflowAreErrors) {
  for (const char* text : {"1e4933", "2^16384", "1e-4990", "2^-16500"})
    EXPECT_NE(refusal<Quad>(text).find("outside the range"), std::string::npos) << text;
  EXPECT_EQ(literal<Quad>("2^16383"), ldexp(Quad(1), 16'383));
  EXPECT_EQ(literal<Quad>("2^-16494"), std::numeric_limits<Quad>::denorm_min());
}

TEST(MpfrLiteral, OverflowIsAnError) {
  const PrecisionScope digits(50);
  for (const char* text :
       {"1e40000", "-1e40000", "1e999999", "2^131072", "exp(1e30)", "10^10^10", "1e30000*1e30000", "sin(1e40000)"})
    EXPECT_FALSE(refusal<Mpfr>(text).empty()) << text;
  EXPECT_EQ(literal<Mpfr>("2^131071"), ldexp(Mpfr(1), 131'071));
}

TEST(MpfrLiteral, SmallNumbersAreNoUnderflow) {
  const PrecisionScope digits(50);
  for (const char* text : {"1e-40000", "-2.5e-999999"}) EXPECT_EQ(to_text(literal<Mpfr>(text)), text);
}

TEST(DoubleLiteral, BelowTheNormalRangeIsRoundedOnce) {
  EXPECT_EQ(literal<double>("2^-1074*(1/2+2^-60)"), 0x1p-1074);
  EXPECT_EQ(literal<double>("2^-1074*(5/2+2^-60)"), 0x3p-1074);
  EXPECT_EQ(literal<double>("2^-1074*(5/2-2^-60)"), 0x2p-1074);
}

TYPED_TEST(Literal, DomainErrorsSayWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"1/0", "division by 0"},
      {"1/(1-1)", "division by 0"},
      {"1/sin(pi)", "division by 0"},
      {"0^-1", "0 to a power"},
      {"(sqrt(2)^2-2)^-2", "0 to a power"},
      {"sqrt(-1)", "square root of a negative number"},
      {"sqrt(2-sqrt(5))", "square root of a negative number"},
      {"log(0)", "logarithm"},
      {"log(-1)", "logarithm"},
      {"log(sqrt(2)^2-2)", "logarithm"},
      {"(-8)^(1/3)", "power of a negative number"},
      {"(-2)^0.5", "power of a negative number"},
  };
  for (const auto& [text, reason] : cases)
    EXPECT_NE(refusal<TypeParam>(text).find(reason), std::string::npos) << text << ": " << refusal<TypeParam>(text);
}

TYPED_TEST(Literal, ErrorsQuoteTheExpression) {
  EXPECT_NE(refusal<TypeParam>("2+1/0").find("'2+1/0'"), std::string::npos);
}

TYPED_TEST(Literal, PowersOfNegativeNumbersAndOfZero) {
  EXPECT_EQ(literal<TypeParam>("(-2)^3"), -8);
  EXPECT_EQ(literal<TypeParam>("(-2)^-2*4"), 1);
  EXPECT_EQ(literal<TypeParam>("(-2)^(4/2)"), 4);
  EXPECT_EQ(literal<TypeParam>("0^0"), 1);
  EXPECT_EQ(literal<TypeParam>("0^2"), 0);
  EXPECT_EQ(literal<TypeParam>("0^0.5"), 0);
  EXPECT_EQ(literal<TypeParam>("(sqrt(2)^2-2)^3"), 0);
  EXPECT_EQ(literal<TypeParam>("(sqrt(2)^2-2)^0.5"), 0);
}

TYPED_TEST(Literal, WholeExponentsAreRecognisedHoweverLong) {
  EXPECT_EQ(literal<TypeParam>("(-1)^1e30"), 1);
  EXPECT_EQ(literal<TypeParam>("(-1)^(1e30+1)"), -1);
}

TYPED_TEST(Literal, WhatCancelsIsZero) {
  for (const char* text : {"sqrt(2)^2-2", "sin(pi)", "cos(pi/2)", "sin(2*pi)", "1/3*3-1", "log(exp(2))-2", "sqrt(1-1)",
                           "sqrt(sqrt(2)^2-2)", "2^(1/2)-sqrt(2)", "sqrt(3+2*sqrt(2))-1-sqrt(2)"})
    EXPECT_EQ(literal<TypeParam>(text), 0) << text;
}

TYPED_TEST(Literal, WhatNearlyCancelsIsRight) {
  EXPECT_EQ(literal<TypeParam>("(1+2^-90)-1"), ldexp(TypeParam(1), -90));
  EXPECT_EQ(literal<TypeParam>("sqrt(2)^2-2+2^-70"), ldexp(TypeParam(1), -70));
  EXPECT_EQ(literal<TypeParam>("exp(2^-60)-1-2^-60"), literal<TypeParam>("2^-121*(1+2^-60/3+2^-120/12+2^-180/60)"));
}

TYPED_TEST(Literal, DifferencesOfLessThanFourTimesTheBitsAreFound) {
  const std::string tiny = "2^-" + std::to_string(3 * significand_bits<TypeParam>());
  EXPECT_EQ(literal<TypeParam>("(1+" + tiny + ")-1"), literal<TypeParam>(tiny));
  EXPECT_EQ(literal<TypeParam>("sqrt(1+" + tiny + ")-1-" + tiny + "/2+1"), 1);
}

/// n, of which nothing is known before some 300 bits.
std::string hidden(int n) { return "((10^90" + std::string(n < 0 ? "" : "+") + std::to_string(n) + ")-10^90)"; }

TYPED_TEST(Literal, BoundsHoldForArgumentsThatAreHardlyKnown) {
  const auto expect_equal = [](const std::string& text, const char* plain) {
    EXPECT_EQ(literal<TypeParam>(text), literal<TypeParam>(plain)) << text;
  };
  expect_equal("-" + hidden(3), "-3");
  expect_equal(hidden(3) + "+1/3", "10/3");
  expect_equal("1/3-" + hidden(3), "-8/3");
  expect_equal(hidden(7) + "-" + hidden(3), "4");
  expect_equal(hidden(7) + "*" + hidden(3), "21");
  expect_equal(hidden(7) + "/" + hidden(3), "7/3");
  expect_equal("sqrt(" + hidden(3) + ")", "sqrt(3)");
  expect_equal("log(" + hidden(3) + ")", "log(3)");
  expect_equal("sin(" + hidden(3) + ")", "sin(3)");
  expect_equal("cos(" + hidden(3) + ")", "cos(3)");
  expect_equal(hidden(3) + "^3", "27");
  expect_equal(hidden(-3) + "^3", "-27");
  expect_equal(hidden(3) + "^0.5", "sqrt(3)");
}

TYPED_TEST(Literal, BoundsThatReachTooFarAreNoOverflow) {
  EXPECT_EQ(literal<TypeParam>("exp(" + hidden(3) + ")"), literal<TypeParam>("exp(3)"));
  EXPECT_EQ(literal<TypeParam>("2^" + hidden(3)), 8);
}

TEST(MpfrLiteral, FiftyDigitsOfADifferenceOfLargerNumbers) {
  const PrecisionScope digits(50);
  EXPECT_EQ(literal<Mpfr>("(1+1e-100-1)+1e-60"), literal<Mpfr>("1e-60+1e-100"));
  EXPECT_NE(literal<Mpfr>("(1+1e-100-1)+1e-60"), literal<Mpfr>("1e-60"));
}

TEST(MpfrLiteral, ZeroIsZeroAtThePrecisionLimitToo) {
  const PrecisionScope digits(10'000);
  EXPECT_EQ(literal<Mpfr>("sqrt(2)^2-2"), 0);
  EXPECT_EQ(literal<Mpfr>("sin(pi)"), 0);
}

TEST(DoubleLiteral, LargeArgumentsAreReducedExactly) {
  EXPECT_EQ(literal<double>("sin(2^1000)"), std::sin(0x1p1000));
  EXPECT_EQ(literal<double>("cos(1e22)"), std::cos(1e22));
}

TEST(DoubleLiteral, AnArgumentOfMoreDigitsThanFourTimesTheResultsIsNotTakenForZero) {
  const double c = literal<double>("cos(1e200)"), s = literal<double>("sin(1e200)");
  EXPECT_LE(std::abs(c * c + s * s - 1), 2 * epsilon<double>());
}

}  // namespace
}  // namespace hbvm::core
