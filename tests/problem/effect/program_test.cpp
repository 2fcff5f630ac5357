#include "hbvm/problem/effect/program.hpp"

#include <cmath>
#include <functional>

#include "hbvm/scalar/binary_exponent.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm {
namespace {

template <class S>
class ProgramTest : public ::testing::Test {
 protected:
  using Code = Program<S>;
  static constexpr Index count = 3;
  PrecisionScope digits{50};
  RandomValues<S> random{59};
  Matrix<S> x = random.matrix(count, 2);
  std::vector<const S*> inputs{x.data(), x.data() + count};

  /// One instruction on the two inputs.
  Vector<S> run(Op op) {
    const Code code({}, {{op, {Bank::input, 0}, {Bank::input, 1}, 0}}, {{Bank::temporary, 0}}, 1);
    Matrix<S> registers = code.make_registers(count);
    code.run(registers, inputs);
    Vector<S> result(count);
    for (Index i = 0; i < count; ++i) result[i] = code.output(0, i, registers, inputs);
    return result;
  }

  void expect(Op op, const std::function<S(const S&, const S&)>& f) {
    const Vector<S> result = run(op);
    for (Index i = 0; i < count; ++i) EXPECT_EQ(result[i], f(x(i, 0), x(i, 1))) << name_of(op);
  }
};
TYPED_TEST_SUITE(ProgramTest, AllScalars, ScalarNames);

TYPED_TEST(ProgramTest, EveryOperationInEveryLane) {
  using S = TypeParam;
  using std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tanh;
  this->x(1, 0) = -magnitude(this->x(1, 0));
  this->expect(Op::add, [](const S& a, const S& b) { return S(a + b); });
  this->expect(Op::subtract, [](const S& a, const S& b) { return S(a - b); });
  this->expect(Op::multiply, [](const S& a, const S& b) { return S(a * b); });
  this->expect(Op::negate, [](const S& a, const S&) { return S(-a); });
  this->expect(Op::abs, [](const S& a, const S&) { return magnitude(a); });
  this->expect(Op::sign, [](const S& a, const S&) { return S(a < 0 ? -1 : 1); });
  this->expect(Op::reciprocal, [](const S& a, const S&) { return S(1 / a); });
  this->expect(Op::sin, [](const S& a, const S&) { return S(sin(a)); });
  this->expect(Op::cos, [](const S& a, const S&) { return S(cos(a)); });
  this->expect(Op::exp, [](const S& a, const S&) { return S(exp(a)); });
  this->expect(Op::sinh, [](const S& a, const S&) { return S(sinh(a)); });
  this->expect(Op::cosh, [](const S& a, const S&) { return S(cosh(a)); });
  this->expect(Op::tanh, [](const S& a, const S&) { return S(tanh(a)); });
  this->expect(Op::atan, [](const S& a, const S&) { return S(atan(a)); });
  for (Index i = 0; i < this->count; ++i) this->x(i, 0) = magnitude(this->x(i, 0));
  this->expect(Op::sqrt, [](const S& a, const S&) { return S(sqrt(a)); });
  this->expect(Op::log, [](const S& a, const S&) { return S(log(a)); });
}

/// sin x / x and its like, at 0, next to it and far from it.
TYPED_TEST(ProgramTest, RatiosToTheArgumentHaveTheirLimitAtZero) {
  using S = TypeParam;
  using std::atan, std::atanh, std::sin, std::sinh, std::sqrt;
  this->x(0, 0) = 0;
  this->x(1, 0) = -sqrt(epsilon<S>());
  const S small = this->x(1, 0), far = this->x(2, 0);
  const std::pair<Op, S> expected[] = {{Op::sinc, S(sin(far) / far)},
                                       {Op::sinhc, S(sinh(far) / far)},
                                       {Op::atanhc, S(atanh(far) / far)},
                                       {Op::atanc, S(atan(far) / far)}};
  const long sixths[] = {-1, 1, 2, -2};
  for (int i = 0; i < 4; ++i) {
    const auto& [op, value] = expected[i];
    const Vector<S> result = this->run(op);
    EXPECT_EQ(result[0], 1) << name_of(op);
    EXPECT_LE(magnitude(S(result[1] - (1 + sixths[i] * small * small / 6))), epsilon<S>()) << name_of(op);
    EXPECT_LE(magnitude(S(result[2] - value)), 4 * epsilon<S>() * magnitude(value)) << name_of(op);
  }
}

TYPED_TEST(ProgramTest, SignOfZeroIsZero) {
  this->x.col(0).setZero();
  EXPECT_EQ(this->run(Op::sign), (Vector<TypeParam>(Vector<TypeParam>::Zero(this->count))));
}

TYPED_TEST(ProgramTest, ConstantsStandOnEitherSide) {
  using S = TypeParam;
  const S seven = 7;
  const Program<S> code({seven},
                        {{Op::subtract, {Bank::constant, 0}, {Bank::input, 0}, 0},
                         {Op::subtract, {Bank::input, 1}, {Bank::constant, 0}, 1}},
                        {{Bank::temporary, 0}, {Bank::temporary, 1}}, 2);
  Matrix<S> registers = code.make_registers(this->count);
  code.run(registers, this->inputs);
  for (Index i = 0; i < this->count; ++i) {
    EXPECT_EQ(code.output(0, i, registers, this->inputs), seven - this->x(i, 0));
    EXPECT_EQ(code.output(1, i, registers, this->inputs), this->x(i, 1) - seven);
  }
}

TYPED_TEST(ProgramTest, AResultMayReplaceItsOperand) {
  using S = TypeParam;
  const Program<S> code({},
                        {{Op::add, {Bank::input, 0}, {Bank::input, 1}, 0},
                         {Op::multiply, {Bank::temporary, 0}, {Bank::temporary, 0}, 0},
                         {Op::negate, {Bank::temporary, 0}, {}, 0}},
                        {{Bank::temporary, 0}}, 1);
  Matrix<S> registers = code.make_registers(this->count);
  code.run(registers, this->inputs);
  for (Index i = 0; i < this->count; ++i) {
    const S sum = this->x(i, 0) + this->x(i, 1);
    EXPECT_EQ(code.output(0, i, registers, this->inputs), -(sum * sum));
  }
}

TYPED_TEST(ProgramTest, OutputsComeFromEveryBank) {
  using S = TypeParam;
  const Program<S> code({S(5)}, {{Op::negate, {Bank::input, 1}, {}, 0}},
                        {{Bank::input, 1}, {Bank::constant, 0}, {Bank::temporary, 0}}, 1);
  ASSERT_EQ(code.outputs(), 3u);
  EXPECT_FALSE(code.is_constant(0));
  EXPECT_TRUE(code.is_constant(1));
  EXPECT_FALSE(code.is_constant(2));
  Matrix<S> registers = code.make_registers(this->count);
  code.run(registers, this->inputs);
  for (Index i = 0; i < this->count; ++i) {
    EXPECT_EQ(code.output(0, i, registers, this->inputs), this->x(i, 1));
    EXPECT_EQ(code.output(1, i, registers, this->inputs), 5);
    EXPECT_EQ(code.output(2, i, registers, this->inputs), -this->x(i, 1));
  }
}

TYPED_TEST(ProgramTest, CountsItsInstructions) {
  const Program<TypeParam> code({},
                                {{Op::add, {Bank::input, 0}, {Bank::input, 1}, 0},
                                 {Op::sqrt, {Bank::temporary, 0}, {}, 0},
                                 {Op::add, {Bank::temporary, 0}, {Bank::input, 1}, 0}},
                                {{Bank::temporary, 0}}, 1);
  OperationCounts expected;
  expected.add(Op::add, 2);
  expected.add(Op::sqrt, 1);
  EXPECT_EQ(code.operations(), expected);
}

/// Of every operation: no more than the numbers on the way, rounded by a unit each, and the slope by the inputs.
TYPED_TEST(ProgramTest, TellsWhatRoundingMakesOfItsOutputs) {
  using S = TypeParam;
  using std::cos, std::exp, std::sin;
  const auto sizes = [](Op op, const S& a, const S& b, const S& of_a, const S& of_b) {
    const Program<S> code({}, {{op, {Bank::input, 0}, {Bank::input, 1}, 0}}, {{Bank::temporary, 0}}, 1);
    return code.rounding_sizes({a, b}, {of_a, of_b}).front();
  };
  const S near = 64 * epsilon<S>();
  const auto expect = [&](Op op, const S& a, const S& expected) {
    EXPECT_LE(magnitude(S(sizes(op, a, S(3), S(2), S(5)) - expected)), near * magnitude(expected)) << name_of(op);
  };
  const S half = S(1) / 2;
  expect(Op::add, half, 2 + 5 + half + 3);
  expect(Op::subtract, half, 2 + 5 + 3 - half);
  expect(Op::multiply, half, 3 * 2 + half * 5 + 3 * half);
  expect(Op::negate, half, 2);
  expect(Op::abs, S(-half), 2);
  expect(Op::sign, half, 0);
  expect(Op::reciprocal, half, 4 * 2 + 2);
  expect(Op::sqrt, S(4), S(2) / 4 + 2);
  expect(Op::sin, half, 2 * cos(half) + sin(half));
  expect(Op::cos, half, 2 * sin(half) + cos(half));
  expect(Op::exp, half, 3 * exp(half));
  // Those without a formula here: by differences.
  const S step = power_of_two<S>(-significand_bits<S>() / 3);
  for (const Op op : {Op::log, Op::sinh, Op::cosh, Op::tanh, Op::atan, Op::sinc, Op::sinhc, Op::atanhc, Op::atanc}) {
    const auto value = [&](const S& a) {
      this->x(0, 0) = a;
      return S(this->run(op)[0]);
    };
    const S slope = (value(half + step) - value(half - step)) / (2 * step);
    const S expected = 2 * magnitude(slope) + magnitude(value(half));
    EXPECT_LE(magnitude(S(sizes(op, half, S(0), S(2), S(0)) - expected)), 64 * step * step) << name_of(op);
  }
}

/// cos x - 1 near 0: a value near 0, with the round-off of 1.
TYPED_TEST(ProgramTest, TellsTheRoundOffOfWhatCancels) {
  using S = TypeParam;
  const Program<S> code(
      {S(1)}, {{Op::cos, {Bank::input, 0}, {}, 0}, {Op::subtract, {Bank::temporary, 0}, {Bank::constant, 0}, 0}},
      {{Bank::temporary, 0}}, 1);
  const S a = power_of_two<S>(-20), size = code.rounding_sizes({a}, {a}).front();
  EXPECT_GE(size, 1);
  EXPECT_LE(size, 3);
}

}  // namespace
}  // namespace hbvm
