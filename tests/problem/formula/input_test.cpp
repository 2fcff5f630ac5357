#include "problem/formula/input.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/trace.hpp"
#include "problem/formula/random_formula.hpp"
#include "scalar/ball.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

const Constants use_constants{{"k", Expression::parse("3/7")}};

/// Of one body in space with a parameter, at the origin of q.
template <Scalar S>
FormulaInput<S> use_of(const Expression& formula, const S& parameter) {
  using Is = FormulaVariable::Is;
  return {formula,
          use_constants,
          3,
          1,
          {{"x", {Is::input, 0}},
           {"y", {Is::input, 1}},
           {"z", {Is::input, 2}},
           {"r", {Is::distance, 0}},
           {"m", {Is::parameter, 0}}},
          1,
          {{{{{{0, S(1)}}, {}}}, {parameter}}}};
}

/// Value, gradient, and the lower triangle of the second derivatives.
template <Scalar S>
std::vector<S> outputs(const EffectTerm<S>& term, const Vector<S>& x) {
  std::vector<S> result;
  const Matrix<S> at = x.transpose();
  for (const auto& [program, coefficients] : {std::pair(&term.value, &term.value_coefficients),
                                              {&term.gradient, &term.gradient_coefficients},
                                              {&term.hessian, &term.hessian_coefficients}}) {
    Execution<S> execution(*program, *coefficients, at, 1);
    execution.run();
    for (std::size_t i = 0; i < program->outputs(); ++i) result.push_back(execution.output(static_cast<Index>(i), 0));
  }
  return result;
}

Expression formula(const std::string& text) { return Expression::parse(text, Expression::Syntax::formula); }

/// Comparison jets of Arb's balls in twice the digits, which share neither reader nor trace nor arithmetic with it.
void expect_random_formulas(unsigned digits, int trials) {
  RandomValues<double> random(static_cast<std::uint64_t>(digits));
  const PrecisionScope scope(digits);
  const BallScope balls(8 * static_cast<slong>(digits));
  for (int trial = 0; trial < trials; ++trial) {
    const RandomFormula tree(random, 1 + trial % 4, {"x", "y", "z", "m"});
    SCOPED_TRACE(tree.text());
    int place[4];
    for (int& p : place) p = static_cast<int>(random.whole(-900, 900));
    std::vector<Jet<RealBall>> variables;
    for (std::size_t i = 0; i < 3; ++i) variables.push_back(Jet<RealBall>::variable(RealBall(place[i]) / 512, i, 3));
    variables.push_back(Jet<RealBall>::number(RealBall(place[3]) / 512, 3));
    const Jet<RealBall> jet = tree.jet(variables);
    std::vector<RealBall> expected{jet.value};
    expected.insert(expected.end(), jet.first.begin(), jet.first.end());
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) expected.push_back(jet.second[i][j]);

    const Expression read = formula(tree.text());
    const EffectTerm<Mpfr> term = make_term(use_of<Mpfr>(read, Mpfr(place[3]) / 512));
    Vector<Mpfr> x(3);
    for (Index i = 0; i < 3; ++i) x[i] = Mpfr(place[i]) / 512;
    const std::vector<Mpfr> found = outputs(term, x);
    ASSERT_EQ(found.size(), expected.size());
    Mpfr size = 1;
    for (const RealBall& ball : expected) raise_to(size, magnitude(rounded_to<Mpfr>(raw(midpoint_of(ball)))));
    // What cancels between terms, of which there are some dozens, takes a few digits.
    const Mpfr tolerance = size * pow(Mpfr(10), 12 - static_cast<int>(digits));
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_LT(rounded_to<Mpfr>(raw(radius_of(expected[i]))), tolerance) << i;
      EXPECT_LE(magnitude(Mpfr(found[i] - rounded_to<Mpfr>(raw(midpoint_of(expected[i]))))), tolerance) << i;
    }
  }
}

TEST(Formula, HasTheDerivativesThatArbHasIn50Digits) { expect_random_formulas(50, 300); }
TEST(Formula, HasTheDerivativesThatArbHasIn500Digits) { expect_random_formulas(500, 300); }

/// What a formula says about x, y, z, r, m at (1, 2, -2), m = 5.
template <Scalar S>
S value_of(const std::string& text) {
  const Expression read = formula(text);
  Vector<S> x(3);
  x << S(1), S(2), S(-2);
  return outputs(make_term(use_of<S>(read, S(5))), x).front();
}

template <class S>
class Formulas : public InDigits<50> {};
TYPED_TEST_SUITE(Formulas, AllScalars, ScalarNames);

TYPED_TEST(Formulas, FollowTheGrammarOfNumbers) {
  using S = TypeParam;
  EXPECT_EQ(value_of<S>("-y^2"), -4);
  EXPECT_EQ(value_of<S>("x*2^3^2"), 512);
  EXPECT_EQ(value_of<S>("y - x - x"), 0);
  EXPECT_EQ(value_of<S>("8/y/y"), 2);
  EXPECT_EQ(value_of<S>("x\n  + y\n"), 3);
  EXPECT_EQ(value_of<S>("r + r^2 + r^3"), 39);
  EXPECT_EQ(value_of<S>("z^2*m"), 20);
  EXPECT_EQ(value_of<S>("(y + y)^(3/2) + (y + y)^(-1/2)"), S(17) / 2);
  EXPECT_EQ(value_of<S>("m^0*y"), 2);
}

TYPED_TEST(Formulas, TakeNumbersAtTheWorkingPrecision) {
  using S = TypeParam;
  EXPECT_EQ(value_of<S>("0.1*x"), literal<S>("1/10"));
  EXPECT_EQ(value_of<S>("k*x"), literal<S>("3/7"));
  // A part without variables is one number, whatever cancels in it.
  EXPECT_EQ(value_of<S>("(10^30 + 1 - 10^30)*x"), 1);
  EXPECT_EQ(value_of<S>("(sqrt(2) - 1.4)*x"), literal<S>("sqrt(2) - 1.4"));
}

TYPED_TEST(Formulas, KnowTheirDegree) {
  using S = TypeParam;
  const auto degree = [](const std::string& text) {
    const Expression read = formula(text);
    return make_term(use_of<S>(read, S(5))).degree;
  };
  EXPECT_EQ(degree("m*k"), 0);
  EXPECT_EQ(degree("sqrt(m)*x + sin(k)"), 1);
  EXPECT_EQ(degree("r^2"), 2);
  EXPECT_EQ(degree("x*y*z - r^4/m"), 4);
  EXPECT_EQ(degree("r"), Trace<S>::not_polynomial);
  EXPECT_EQ(degree("x^(1/2)"), Trace<S>::not_polynomial);
  EXPECT_EQ(degree("((x^1000)^1000)^1000"), Trace<S>::not_polynomial) << "beyond what an exponent holds";
}

/// In double tanh of large numbers is 1, not a ratio of what overflows, and sinh of small ones keeps its digits.
TEST(Formula, KeepsDigitsWhereComposedFunctionsLoseThem) {
  EXPECT_EQ(value_of<double>("tanh(1000*x)"), 1);
  EXPECT_EQ(value_of<double>("sinh(x*1e-20)"), literal<double>("1e-20"));
  const Expression read = formula("tanh(20*x)");
  Vector<double> x(3);
  x << 1, 0, 0;
  const double slope = outputs(make_term(use_of<double>(read, double{5})), x)[1];
  const double expected = literal<double>("20/cosh(20)^2");
  EXPECT_LE(magnitude(slope - expected), 8 * epsilon<double>() * expected);
}

std::string refusal_of(const std::string& text, const char* at) {
  try {
    const Expression read = formula(text);
    const FormulaInput<double> input = use_of<double>(read, literal<double>("5"));
    Vector<double> q(3);
    q << literal<double>(at), 2, -2;
    check_formula(input, make_term(input), q);
  } catch (const ExpressionError& error) {
    return std::to_string(error.at() + 1) + ": " + error.reason();
  }
  return {};
}

TEST(Formula, IsRefusedWhereItHasNoValue) {
  EXPECT_EQ(refusal_of("y + 1/x", "1"), "");
  EXPECT_EQ(refusal_of("y + 1/x", "0"), "6: division by 0 at the start");
  EXPECT_EQ(refusal_of("y*log(-x)", "1"), "3: logarithm of a number that is not positive at the start");
  EXPECT_EQ(refusal_of("sqrt(x - y)", "1"), "1: square root of a negative number at the start");
  EXPECT_EQ(refusal_of("(x - y)^(1/3)", "1"), "8: a power without a value at the start");
  EXPECT_EQ(refusal_of("exp(1000*y)", "1"), "1: a value beyond the range of numbers at the start");
  EXPECT_EQ(refusal_of("y + asin(x)", "2"), "5: arc sine or cosine of a number beyond 1 at the start");
  EXPECT_EQ(refusal_of("acos(x)", "-2"), "1: arc sine or cosine of a number beyond 1 at the start");
  EXPECT_EQ(refusal_of("acos(x)", "1"), "1: a derivative has no value at the start");
  EXPECT_EQ(refusal_of("atan2(y - 2, -x)", "1"), "1: angle of a point with y = 0 and x <= 0 at the start");
  EXPECT_EQ(refusal_of("atan2(y, x)", "0"), "");
  EXPECT_EQ(refusal_of("sqrt(x^2)", "0"), "1: a derivative has no value at the start");
  EXPECT_EQ(refusal_of("x + 1/(2 - 2)", "0"), "6: division by 0");
  EXPECT_EQ(refusal_of("x^2000", "0"), "2: the exponent must be from -1000 to 1000");
}

TEST(Formula, OfTooManyOperationsIsRefused) {
  std::string text = "x";
  for (int i = 0; i < 90; ++i) text = "(" + text + ")^999*sin(y + z*" + std::to_string(i) + ")";
  const Expression read = formula(text);
  // It may be long, but takes no longer than it is.
  EXPECT_NO_THROW(make_term(use_of<double>(read, double{1})));
}

}  // namespace
}  // namespace hbvm::core
