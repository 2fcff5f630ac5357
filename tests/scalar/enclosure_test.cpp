// Correct rounding of random expressions, against ball arithmetic of FLINT/Arb on the same tree.

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <utility>

#include "scalar/ball.hpp"
#include "scalar/expression.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

/// How tightly a text binds, in the order of the grammar.
enum class Binding { sum, product, sign, power, primary };

struct Formula {
  std::string text{};
  Binding binding = Binding::primary;
  RealBall value{};

  std::string at_least(Binding needed) const { return binding >= needed ? text : "(" + text + ")"; }
};

/// Random formulas with the brackets their meaning needs and no others.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : engine_(seed) {}

  Formula formula(int depth) {
    if (depth == 0 || pick(10) == 0) return leaf();
    for (;;)
      if (const auto result = operation(depth)) return *result;
  }

 private:
  int pick(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  std::string blank() { return pick(4) == 0 ? " " : ""; }

  Formula leaf() {
    switch (pick(4)) {
      case 0: {
        Formula pi{"pi", Binding::primary, {}};
        arb_const_pi(raw(pi.value), BallScope::bits());
        return pi;
      }
      case 1: {
        const int n = 1 + pick(20);
        return {std::to_string(n), Binding::primary, RealBall(n)};
      }
      default: {
        const int whole = pick(30), thousandths = 1 + pick(999), exponent = pick(7) - 3;
        std::string digits = std::to_string(thousandths);
        digits.insert(0, 3 - digits.size(), '0');
        Formula decimal{std::to_string(whole) + "." + digits, Binding::primary,
                        RealBall(1000 * whole + thousandths) * pow(RealBall(10), RealBall(exponent - 3))};
        if (exponent != 0) decimal.text += "e" + std::to_string(exponent);
        return decimal;
      }
    }
  }

  static long exponent_of(const RealBall& x) {
    BigFloat middle(53);
    arf_get_mpfr(raw(middle), arb_midref(raw(x)), MPFR_RNDN);
    return mpfr_zero_p(raw(middle)) ? 0 : static_cast<long>(mpfr_get_exp(raw(middle)));
  }

  std::optional<Formula> operation(int depth) {
    const Formula a = formula(depth - 1);
    Formula result;
    const auto function = [&](const char* name, const RealBall& value) {
      result.text = std::string(name) + blank() + "(" + a.text + ")";
      result.value = value;
    };
    const auto infix = [&](const char* op, const Formula& b, const RealBall& value, Binding own, Binding left,
                           Binding right) {
      result.text = a.at_least(left) + blank() + op + blank() + b.at_least(right);
      result.binding = own;
      result.value = value;
    };
    const int kind = pick(13);
    switch (kind) {
      case 6: {
        Formula b;
        if (pick(2) == 0) {
          const int n = pick(9) - 4;
          if (arb_contains_zero(raw(a.value))) return std::nullopt;
          b = {std::to_string(n), n < 0 ? Binding::sign : Binding::primary, RealBall(n)};
        } else {
          b = formula(depth - 1);
          if (!arb_is_positive(raw(a.value)) || exponent_of(b.value) > 5) return std::nullopt;
        }
        if (std::labs(exponent_of(a.value)) > 200) return std::nullopt;
        infix("^", b, pow(a.value, b.value), Binding::power, Binding::primary, Binding::sign);
        break;
      }
      case 7:
        result = {"-" + blank() + a.at_least(Binding::sign), Binding::sign, -a.value};
        break;
      case 8:
        if (!arb_is_positive(raw(a.value))) return std::nullopt;
        pick(2) == 0 ? function("sqrt", sqrt(a.value)) : function("log", log(a.value));
        break;
      case 9:
        if (exponent_of(a.value) > 40) return std::nullopt;
        pick(2) == 0 ? function("sin", sin(a.value)) : function("cos", cos(a.value));
        break;
      case 10:
        if (exponent_of(a.value) > 8) return std::nullopt;
        function("exp", exp(a.value));
        break;
      case 11: {
        if (exponent_of(a.value) > 8) return std::nullopt;
        static const std::pair<const char*, RealBall (*)(const RealBall&)> more[] = {
            {"tan", tan},   {"sinh", sinh}, {"cosh", cosh}, {"tanh", tanh},
            {"asin", asin}, {"acos", acos}, {"atan", atan}};
        const auto& [name, f] = more[pick(7)];
        function(name, f(a.value));
        break;
      }
      case 12: {
        if (pick(2) == 0) {
          result.text = "abs(" + a.text + ")";
          arb_abs(raw(result.value), raw(a.value));
          break;
        }
        const Formula b = formula(depth - 1);
        result.text = "atan2(" + a.text + "," + blank() + b.text + ")";
        result.value = atan2(a.value, b.value);
        break;
      }
      default: {
        // Sums and differences are twice as many as products and quotients.
        using Infix = RealBall (*)(const RealBall&, const RealBall&);
        static const std::pair<const char*, Infix> infixes[] = {
            {"+", operator+ },
             {"+", operator+ }, {"-", operator- }, {"-", operator- }, {"*", operator* }, {"/", operator/ } };
        const auto& [op, f] = infixes[kind];
        const Formula b = formula(depth - 1);
        if (kind == 5 && arb_contains_zero(raw(b.value))) return std::nullopt;
        const Binding own = kind < 4 ? Binding::sum : Binding::product;
        infix(op, b, f(a.value, b.value), own, own, kind < 4 ? Binding::product : Binding::sign);
      }
    }
    if (!arb_is_finite(raw(result.value)) || std::labs(exponent_of(result.value)) > 20'000) return std::nullopt;
    return result;
  }

  std::mt19937_64 engine_;
};

class RandomExpressions : public ::testing::TestWithParam<int> {};

TEST_P(RandomExpressions, AreRoundedCorrectly) {
  const PrecisionScope scope(static_cast<unsigned>(GetParam()));
  const int bits = mpfr_working_bits();
  const BallScope balls(6 * bits + 1'000);
  Generator generator(2024);
  int not_zero = 0;
  for (int trial = 0; trial < 1'000; ++trial) {
    const Formula formula = generator.formula(2 + trial % 4);
    SCOPED_TRACE(formula.text);
    const BigFloat value = Expression::parse(formula.text).evaluate_to_bits(bits);
    ASSERT_EQ(mpfr_get_prec(raw(value)), bits);
    if (arb_contains_zero(raw(formula.value))) {
      EXPECT_NE(mpfr_zero_p(raw(value)), 0);
      continue;
    }
    ++not_zero;
    ASSERT_GT(arb_rel_accuracy_bits(raw(formula.value)), 2 * bits);
    ASSERT_NE(mpfr_regular_p(raw(value)), 0);
    RealBall found, half_ulp(1);
    arf_set_mpfr(arb_midref(raw(found)), raw(value));
    RealBall distance = found - formula.value;
    arb_abs(raw(distance), raw(distance));
    arb_mul_2exp_si(raw(half_ulp), raw(half_ulp), mpfr_get_exp(raw(value)) - bits - 1);
    // Certainly more than half an ulp away: wrong. (Half way itself is undecided in balls.)
    EXPECT_FALSE(arb_gt(raw(distance), raw(half_ulp)));
  }
  EXPECT_GT(not_zero, 950);
}

INSTANTIATE_TEST_SUITE_P(Digits, RandomExpressions, ::testing::Values(50, 500));

/// exp(90000) has 130 000 bits before the point, and its sine needs them all.
TEST(Work, IsLimited) {
  std::string sum = "sin(exp(90000))";
  EXPECT_NO_THROW(Expression::parse(sum).evaluate_to_bits(53));
  for (int i = 1; i < 150; ++i) sum += "+sin(exp(90000))";
  EXPECT_THROW(Expression::parse(sum).evaluate_to_bits(53), ExpressionError);
  Constants chain{{"c0", Expression::parse("1")}};
  for (int i = 1; i < 60; ++i)
    chain.emplace("c" + std::to_string(i), Expression::parse("sin(exp(90000))+c" + std::to_string(i - 1)));
  EXPECT_THROW(Expression::parse("c59").evaluate_to_bits(53, chain), ExpressionError);
}

TEST(Work, SufficesForAllOperationsOfAnExpression) {
  std::string sum = "sin(1)";
  for (int i = 2; i < 200; ++i) sum += "+exp(sin(" + std::to_string(i) + "))";
  EXPECT_NO_THROW(Expression::parse(sum).evaluate_to_bits(53));
  EXPECT_NO_THROW(Expression::parse(sum).evaluate_to_bits(2'000));
}

}  // namespace
}  // namespace hbvm::core
