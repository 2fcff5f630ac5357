#include "reference/between/ball_program.hpp"

#include <cmath>
#include <functional>

#include "printing.hpp"
#include "problem/effect/trace.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

using Value = Traced<Mpfr>;

/// A function of one input, x = middle + tau, on circles about tau = 0.
class OnCircles {
 public:
  OnCircles(const std::function<Value(const Value&)>& f, const char* middle) : middle_(literal<Mpfr>(middle)) {
    Trace<Mpfr> trace;
    const Value y = f(Value(trace, trace.input(0)));
    program_ = trace.compile({y.id()}, 1, 0).program;
  }

  /// Whether it is analytic within the radius and at most 2^log2_limit on it.
  bool is_bounded(double radius, double log2_limit = 300) {
    const std::vector<Mpfr> series{middle_, Mpfr(1)};
    const std::vector<Loop> loops{
        circle_of([&](Index n) -> const Mpfr& { return series[static_cast<std::size_t>(n)]; }, 1, std::log2(radius))};
    BallProgram balls(program_, 1, {});
    const bool result = balls.is_bounded(loops, {log2_limit});
    obstacle = balls.obstacle();
    return result;
  }

  /// It is analytic up to this radius, and not beyond.
  void expect_singularity_at(double radius, const char* name) {
    constexpr double near = 0.01;
    EXPECT_TRUE(is_bounded(radius * (1 - near))) << name << ": " << obstacle;
    EXPECT_FALSE(is_bounded(radius * (1 + near))) << name;
    EXPECT_FALSE(is_bounded(radius * 1.7)) << name;
  }

  std::string obstacle;

 private:
  PrecisionScope scope_{30};
  Mpfr middle_;
  Program<Mpfr> program_;
};

/// Each operation by the singularities that it is known to have, at either side and off the real axis.
TEST(BallProgram, FindsSingularities) {
  OnCircles([](const Value& x) { return 1 / x; }, "3/2").expect_singularity_at(1.5, "1/x");
  OnCircles([](const Value& x) { return 1 / x; }, "-3/2").expect_singularity_at(1.5, "1/x, x < 0");
  OnCircles([](const Value& x) { return 1 / (x * x + 1); }, "0").expect_singularity_at(1, "1/(x^2 + 1) at 0");
  OnCircles([](const Value& x) { return 1 / (x * x + 1); }, "2")
      .expect_singularity_at(std::sqrt(5.0), "1/(x^2 + 1) at 2");
  OnCircles([](const Value& x) { return sqrt(x); }, "2").expect_singularity_at(2, "sqrt x");
  OnCircles([](const Value& x) { return sqrt(x * x + 4); }, "1").expect_singularity_at(std::sqrt(5.0), "sqrt(x^2 + 4)");
  OnCircles([](const Value& x) { return log(x); }, "1/3").expect_singularity_at(1 / 3.0, "log x");
  OnCircles([](const Value& x) { return tanh(x); }, "1")
      .expect_singularity_at(std::hypot(1, std::numbers::pi / 2), "tanh x");
  OnCircles([](const Value& x) { return atan(x); }, "-1").expect_singularity_at(std::sqrt(2.0), "atan x");
  OnCircles([](const Value& x) { return abs(x); }, "-2").expect_singularity_at(2, "|x|");
}

/// A pole of a high order, or two zeros that a curve goes round, turn several times.
TEST(BallProgram, CountsTurns) {
  const auto quartic = [](const Value& x) { return 1 / ((x * x + 1) * (x * x + 1)); };
  EXPECT_FALSE(OnCircles(quartic, "0").is_bounded(1.5));
  const auto two = [](const Value& x) { return sqrt((x - 1) * (x - 2)); };
  EXPECT_FALSE(OnCircles(two, "0").is_bounded(3)) << "between 1 and 2 it is not real";
  EXPECT_TRUE(OnCircles(two, "0").is_bounded(0.95));
}

/// Entire functions are bounded by what they are on the curve.
TEST(BallProgram, BoundsValues) {
  const double log2_e = std::numbers::log2e;
  const auto expect_size = [](OnCircles function, double radius, double log2_size, const char* name) {
    EXPECT_TRUE(function.is_bounded(radius, log2_size + 0.3)) << name << ": " << function.obstacle;
    EXPECT_FALSE(function.is_bounded(radius, log2_size - 0.1)) << name;
  };
  expect_size({[](const Value& x) { return exp(x); }, "0"}, 5, 5 * log2_e, "exp");
  expect_size({[](const Value& x) { return sin(x); }, "0"}, 6, 6 * log2_e - 1, "sin");
  expect_size({[](const Value& x) { return cos(x); }, "1"}, 6, 6 * log2_e - 1, "cos");
  expect_size({[](const Value& x) { return sinh(x) + cosh(x); }, "0"}, 4, 4 * log2_e, "sinh + cosh");
  expect_size({[](const Value& x) { return exp(-(x * x)); }, "0"}, 3, 9 * log2_e, "a bell curve");
  expect_size({[](const Value& x) { return x * x * x - 2 * x; }, "1"}, 1, 2, "a polynomial");
}

/// sqrt(e^x) is e^(x/2) on all the curve, and log(e^x) is x, where e^x turns more than once and back. Roots and
/// logarithms of principal branches would jump.
TEST(BallProgram, ContinuesBranches) {
  OnCircles root([](const Value& x) { return sqrt(exp(x)) - exp(x / 2); }, "0");
  // At x = 6 i, where |e^(x/2)| is 1, the other branch would be 2 away; at x = 6 it is e^3.
  EXPECT_TRUE(root.is_bounded(6, 2)) << root.obstacle;
  OnCircles logarithm([](const Value& x) { return log(exp(x)) - x; }, "0");
  EXPECT_TRUE(logarithm.is_bounded(12, 1)) << logarithm.obstacle;
  OnCircles arc([](const Value& x) { return atan(x) - (x - x * x * x / 3); }, "0");
  EXPECT_TRUE(arc.is_bounded(0.5, -6)) << arc.obstacle;
}

/// A bump of width 1e-6 at a distance of 1 is seen from the real axis' side, too.
TEST(BallProgram, SeesABumpBesideTheCurve) {
  const auto bump = [](const Value& x) { return exp(-(1000000 * x) * (1000000 * x)); };
  OnCircles function(bump, "1");
  EXPECT_TRUE(function.is_bounded(0.5, 0)) << function.obstacle;
  EXPECT_FALSE(function.is_bounded(0.9, 0));
  EXPECT_FALSE(function.is_bounded(2, 0));
}

/// Steep functions are analytic up to the line of poles beside the real axis, though exp turns thousands of times on
/// such circles. They are not beyond.
TEST(BallProgram, SeesSteepWallsFromAfar) {
  const double pole = std::hypot(1, 1e-5 * std::numbers::pi / 2), double_pole = std::hypot(1, 1e-5 * std::numbers::pi);
  for (const char* side : {"1", "-1"}) {
    const auto steep = [](const Value& x) { return 100000 * x; };
    OnCircles([&](const Value& x) { return tanh(steep(x)); }, side).expect_singularity_at(pole, "tanh");
    OnCircles([&](const Value& x) { return 1 / cosh(steep(x)); }, side).expect_singularity_at(pole, "1/cosh");
    OnCircles([&](const Value& x) { return 1 / sinh(steep(x)); }, side).expect_singularity_at(1, "1/sinh");
    OnCircles([&](const Value& x) { return 1 / (exp(steep(x)) + 3); }, side)
        .expect_singularity_at(double_pole, "1/(exp + 3)");
    OnCircles([&](const Value& x) { return 1 / (exp(steep(x)) - 3); }, side).expect_singularity_at(1, "1/(exp - 3)");
    OnCircles([&](const Value& x) { return exp(steep(x)) / (exp(2 * steep(x)) + 5 * exp(steep(x)) + 1); }, side)
        .expect_singularity_at(1, "of two exponentials");
  }
}

/// Values kept beside an exponential are what they are: sums of like and unlike ones, products, quotients, negatives.
TEST(BallProgram, KeepsExponentsApart) {
  const auto expect_small = [](const std::function<Value(const Value&)>& f, const char* middle, const char* name) {
    OnCircles function(f, middle);
    // Balls of arcs are some hundredths wide.
    EXPECT_TRUE(function.is_bounded(1, 0)) << name << ": " << function.obstacle;
  };
  for (const char* middle : {"5/2", "-5/2"}) {
    expect_small([](const Value& x) { return exp(x) * exp(-x) - 1; }, middle, "exp(x) exp(-x)");
    expect_small([](const Value& x) { return 1 / exp(x) - exp(-x); }, middle, "1/exp(x)");
    expect_small([](const Value& x) { return (cosh(x) - sinh(x)) * exp(x) - 1; }, middle, "cosh - sinh");
    expect_small([](const Value& x) { return (cosh(x) + sinh(x)) * exp(-x) - 1; }, middle, "cosh + sinh");
    expect_small([](const Value& x) { return sinh(x) / cosh(x) - tanh(x); }, middle, "sinh/cosh");
    expect_small([](const Value& x) { return (exp(x) + 2) * exp(-x) - 2 * exp(-x) - 1; }, middle, "exp + 2");
    expect_small([](const Value& x) { return (exp(2 * x) - exp(x)) * exp(-(2 * x)) + exp(-x) - 1; }, middle,
                 "of two exponentials");
    expect_small([](const Value& x) { return sin(exp(x / 10) - exp(x / 10)); }, middle, "sin of an exponential");
  }
}

/// The same program on one curve after another: what it decided on the one is not left on the next.
TEST(BallProgram, DecidesAnewOnEachCurve) {
  Trace<Mpfr> trace;
  const PrecisionScope scope(30);
  const Value x(trace, trace.input(0));
  const Program<Mpfr> program = trace.compile({(exp(x) + 1).id()}, 1, 0).program;
  BallProgram balls(program, 1, {});
  for (const int middle : {20, -20, 20, 0}) {
    const std::vector<Mpfr> series{Mpfr(middle), Mpfr(1)};
    const std::vector<Loop> loops{
        circle_of([&](Index n) -> const Mpfr& { return series[static_cast<std::size_t>(n)]; }, 1, 0)};
    const double log2_size = std::log2(1 + std::exp(middle + 1.0));
    EXPECT_TRUE(balls.is_bounded(loops, {log2_size + 1.2})) << middle << " " << balls.obstacle();
    EXPECT_FALSE(balls.is_bounded(loops, {log2_size - 1.2})) << middle;
  }
}

TEST(BallProgram, SaysWhatIsInTheWay) {
  OnCircles pole([](const Value& x) { return 1 / x; }, "1");
  EXPECT_FALSE(pole.is_bounded(1));
  EXPECT_EQ(pole.obstacle, "a division by 0");
  OnCircles bump([](const Value& x) { return exp(x); }, "1");
  EXPECT_FALSE(bump.is_bounded(10, 0));
  EXPECT_EQ(bump.obstacle, "a force that changes too much");
}

}  // namespace
}  // namespace hbvm::core
