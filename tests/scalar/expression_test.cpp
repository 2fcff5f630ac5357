#include "scalar/expression.hpp"

#include <gtest/gtest.h>

#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// What parse() refuses the text with.
std::string refusal(const std::string& text) {
  return message_of<ExpressionError>([&] { Expression::parse(text); });
}

struct Misfit {
  const char* text;
  int column;
  const char* found;
};

void PrintTo(const Misfit& misfit, std::ostream* out) { *out << "'" << misfit.text << "'"; }

class ParseError : public ::testing::TestWithParam<Misfit> {};

TEST_P(ParseError, NamesTheTextTheColumnAndTheCharacter) {
  const Misfit& misfit = GetParam();
  const std::string message = refusal(misfit.text);
  const std::string start =
      "'" + std::string(misfit.text) + "', column " + std::to_string(misfit.column) + ": " + misfit.found;
  EXPECT_TRUE(message.starts_with(start)) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Expression, ParseError,
    ::testing::Values(Misfit{"", 1, "the end "}, Misfit{"   ", 4, "the end "}, Misfit{"1+", 3, "the end "},
                      Misfit{"1 + ", 5, "the end "}, Misfit{"*2", 1, "'*' "}, Misfit{"2 3", 3, "'3' "},
                      Misfit{"2)", 2, "')' "}, Misfit{"(2", 3, "the end "}, Misfit{"((1+2)*3", 9, "the end "},
                      Misfit{"()", 2, "')' "}, Misfit{"1..2", 3, "'.' "}, Misfit{".", 2, "the end "},
                      Misfit{"1e", 3, "the end "}, Misfit{"1e+", 4, "the end "}, Misfit{"1e+x", 4, "'x' "},
                      Misfit{"1e1234567", 10, "the end "}, Misfit{"2^", 3, "the end "}, Misfit{"2^*3", 3, "'*' "},
                      Misfit{"sin", 4, "the end "}, Misfit{"sin 1", 5, "'1' "}, Misfit{"sqrt()", 6, "')' "},
                      Misfit{"sqrt(2", 7, "the end "}, Misfit{"sqrt(1,2)", 7, "',' "}, Misfit{"1,5", 2, "',' "},
                      Misfit{"1\n+1", 2, "'\n' "}, Misfit{"0x10", 2, "'x' "}, Misfit{"2pi", 2, "'p' "},
                      Misfit{"pi(2)", 3, "'(' "}, Misfit{"a(2)", 2, "'(' "}, Misfit{"[1]", 1, "'[' "},
                      Misfit{"2**3", 3, "'*' "}, Misfit{"1=1", 2, "'=' "}, Misfit{"$", 1, "'$' "}));

TEST(Expression, ErrorsAreInputErrors) { EXPECT_THROW(Expression::parse("1+"), InputError); }

TEST(Expression, ColumnOfAnErrorInsideALongText) {
  EXPECT_NE(refusal(std::string(150, '-') + "1 + ?").find("column 155: '?' "), std::string::npos);
}

struct Example {
  const char* text;
  double value;
};

void PrintTo(const Example& example, std::ostream* out) { *out << "'" << example.text << "'"; }

class Value : public ::testing::TestWithParam<Example> {};

TEST_P(Value, IsExact) { EXPECT_EQ(literal<double>(GetParam().text), GetParam().value); }

INSTANTIATE_TEST_SUITE_P(Precedence, Value,
                         ::testing::Values(Example{"-2^2", -4}, Example{"(-2)^2", 4}, Example{"2^3^2", 512},
                                           Example{"(2^3)^2", 64}, Example{"2^-3", 0.125}, Example{"2^-2^2", 0.0625},
                                           Example{"-2^-2", -0.25}, Example{"2*3^2", 18}, Example{"2+3*4", 14},
                                           Example{"(2+3)*4", 20}, Example{"10-3-2", 5}, Example{"64/4/2", 8},
                                           Example{"64/4*2", 32}, Example{"2-3+4", 3}, Example{"2*-3", -6},
                                           Example{"8/-2^2", -2}, Example{"2--3", 5}, Example{"--2", 2},
                                           Example{"+-+2", -2}, Example{"-(-2)^2", -4}, Example{"-(1+2)^2", -9}));

INSTANTIATE_TEST_SUITE_P(Numbers, Value,
                         ::testing::Values(Example{"0", 0}, Example{"007", 7}, Example{"5.", 5}, Example{".5", 0.5},
                                           Example{"5.e2", 500}, Example{".5e-1", 0.05}, Example{"1E3", 1000},
                                           Example{"1e+3", 1000}, Example{"0e999999", 0}, Example{"0.1", 0.1},
                                           Example{"123456789012345678901234567890",
                                                   123456789012345678901234567890.0}));

INSTANTIATE_TEST_SUITE_P(Blanks, Value,
                         ::testing::Values(Example{" 1 + 2 ", 3}, Example{"\t1\t+\t2", 3}, Example{"( 1 + 2 ) * 3", 9},
                                           Example{"sqrt ( 4 )", 2}, Example{"2 ^ - 1", 0.5}));

INSTANTIATE_TEST_SUITE_P(
    Functions, Value,
    ::testing::Values(
        Example{"sqrt(9)", 3}, Example{"exp(0)", 1}, Example{"log(1)", 0}, Example{"sin(0)", 0}, Example{"cos(0)", 1},
        Example{"4*cos(pi/3)", 2}, Example{"log(exp(3))", 3}, Example{"exp(log(7))", 7}, Example{"tan(pi/4)", 1},
        Example{"sinh(log(3))*3", 4}, Example{"cosh(-log(3))*3", 5}, Example{"cosh(0)", 1},
        Example{"tanh(log(3))*5", 4}, Example{"4*atan(1)/pi", 1}, Example{"6*asin(1/2)/pi", 1},
        Example{"2*asin(1)/pi", 1}, Example{"2*asin(-1)/pi", -1}, Example{"3*acos(1/2)/pi", 1}, Example{"acos(1)", 0},
        Example{"acos(-1)/pi", 1}, Example{"2*asin(sqrt(2)*sqrt(2)/2)/pi", 1}, Example{"acos(-3*(1/3))/pi", 1},
        Example{"4*atan2(1, 1)/pi", 1}, Example{"4*atan2(1, -1)/pi", 3}, Example{"4*atan2(-1, -1)/pi", -3},
        Example{"2*atan2(-2, 0)/pi", -1}, Example{"atan2(0, -5)/pi", 1}, Example{"atan2(-0, -5)/pi", 1},
        Example{"atan2(sin(pi), -1)/pi", 1}, Example{"atan2(0, 7)", 0}, Example{"abs(-7/2)", 3.5}, Example{"abs(2)", 2},
        Example{"abs(0)", 0}, Example{"abs(1 - sqrt(2)*sqrt(2)/2)", 0}, Example{"sqrt(2)*sqrt(2)", 2},
        Example{"8^(1/3)", 2}, Example{"sin(pi/6)", 0.5}, Example{"pi", 3.141592653589793}));

TEST(Expression, HasNoValueOutsideADomain) {
  for (const auto& [text, reason] : {std::pair("asin(1 + 1e-60)", "beyond 1"),
                                     {"asin(-2)", "beyond 1"},
                                     {"acos(1.5)", "beyond 1"},
                                     {"acos(-1 - 1e-60)", "beyond 1"},
                                     {"atan2(0, 0)", "angle of the point 0"},
                                     {"atan2(sin(pi), cos(pi/2))", "angle of the point 0"}})
    expect_words(message_of<ExpressionError>([&, text = text] { literal<double>(text); }), {text, reason});
}

TEST(Expression, TakesTheTwoArgumentsOfAnAngle) {
  expect_words(message_of<ExpressionError>([] { Expression::parse("atan2(1)"); }), {"column 8", "atan2(y, x)"});
  EXPECT_THROW(Expression::parse("sin(1, 2)"), ExpressionError);
  EXPECT_THROW(Expression::parse("atan2(1, 2, 3)"), ExpressionError);
  EXPECT_THROW(Expression::parse("(1, 2)"), ExpressionError);
}

TEST(Expression, OfAnObservationHasNamesOfQuantities) {
  const auto names = [](const char* text) { return Expression::parse(text, Expression::Syntax::observation).names(); };
  EXPECT_EQ(names("sqrt(a.d1.x^2) + L*angle( a.d1,b )/energy()"),
            (std::set<std::string>{"a.d1.x", "L", "angle(a.d1, b)", "energy()"}));
  EXPECT_EQ(names("distance(bar[(1/2), 0],  the pivot )"),
            (std::set<std::string>{"distance(bar[(1/2), 0], the pivot)"}));
  for (const char* const text : {"distance(a, b", "angle(a))", "a.b.c.d", "2 distance(a, b)", "f(a)(b)"})
    EXPECT_THROW(names(text), ExpressionError) << text;
  EXPECT_THROW(Expression::parse("a.d1.x", Expression::Syntax::formula), ExpressionError);
}

TEST(Expression, UnknownFunctionsListThoseThereAre) {
  for (const auto& [text, words] :
       {std::pair("1 + atan3(y, x)", "column 5: 'atan3' is no function: did you mean 'atan'? There are sqrt, sin,"),
        {"mod(x)",
         "'mod' is no function; there are sqrt, sin, cos, tan, exp, log, sinh, cosh, tanh, asin, acos, atan, "},
        {"mu(x + 1)", "if it is a name, a product is written mu*(...)"}})
    expect_words(
        message_of<ExpressionError>([&, text = text] { Expression::parse(text, Expression::Syntax::formula); }),
        {words});
  EXPECT_THROW(Expression::parse("k(x + 1)", Expression::Syntax::formula), ExpressionError);
}

TEST(Expression, NamesAreWhatIsNeitherAFunctionNorPi) {
  EXPECT_EQ(Expression::parse("2*a + sin(b_1)^a - pi*sqrt(_c)/Pi").names(),
            (std::set<std::string>{"a", "b_1", "_c", "Pi"}));
  EXPECT_TRUE(Expression::parse("1+pi").names().empty());
}

TEST(Expression, KeepsItsText) { EXPECT_EQ(Expression::parse(" 1 +2").text(), " 1 +2"); }

TEST(Expression, ReadsAThousandOperationsAtMost) {
  std::string sum = "1";
  for (int i = 1; i < 500; ++i) sum += "+1";
  EXPECT_EQ(literal<double>(sum), 500);
  for (int i = 500; i < 100'000; ++i) sum += "+1";
  EXPECT_NE(refusal(sum).find("too many operations"), std::string::npos);
}

TEST(Expression, DeepNestingIsAnErrorAndNoCrash) {
  constexpr int deep = 100'000;
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  for (const std::string& text : {repeated("(", deep) + "1" + repeated(")", deep), repeated("(", deep),
                                  repeated("sin(", deep) + "1" + repeated(")", deep), repeated("2^", deep) + "2",
                                  repeated("-(", deep) + "1" + repeated(")", deep), repeated("2^-", deep) + "2",
                                  repeated("1+(", deep) + "1" + repeated(")", deep), repeated("1*", deep) + "1"})
    EXPECT_FALSE(refusal(text).empty()) << text.substr(0, 10);
  EXPECT_EQ(literal<double>(repeated("(", 50) + "1" + repeated(")", 50)), 1);
}

TEST(Expression, ManySignsAreNoNesting) { EXPECT_EQ(literal<double>(std::string(100'001, '-') + "1"), -1); }

}  // namespace
}  // namespace hbvm::core
