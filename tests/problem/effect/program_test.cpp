#include "problem/effect/program.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ProgramTest : public InDigits<50> {
 protected:
  using Code = Program<S>;
  static constexpr Index count = 3;
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

/// Straight-line code with every number rounded on the way, and inputs that are wrong by up to half a unit. It is held
/// against itself in twice the digits with the exact inputs.
template <Scalar S>
class RoundingBound {
 public:
  RoundingBound(std::vector<S> constants, std::vector<Instruction> code, std::uint32_t temporaries)
      : constants_(std::move(constants)),
        code_(std::move(code)),
        temporaries_(temporaries),
        program_(constants_, code_, {{Bank::temporary, temporaries - 1}}, temporaries) {}

  /// The error over what rounding_sizes allows, a unit each, at inputs x and exact ones x (1 + epsilon u).
  double share(const std::vector<S>& x, const std::vector<double>& u) const {
    std::vector<S> sizes;
    for (const S& value : x) sizes.push_back(magnitude(value));
    const S unit = epsilon<S>(), bound = program_.rounding_sizes(x, sizes).front() * unit, rounded = run(program_, x);
    const PrecisionScope scope(2 * static_cast<unsigned>(digits10<S>()) + 20);
    std::vector<Mpfr> constants, exact_x;
    for (const S& value : constants_) constants.push_back(exact(value));
    for (std::size_t i = 0; i < x.size(); ++i) exact_x.push_back(exact(x[i]) * (1 + exact(unit) * Mpfr(u[i]) / 2));
    const Program<Mpfr> program(constants, code_, program_.output_operands(), temporaries_);
    return approximately(Mpfr(abs(Mpfr(exact(rounded) - run(program, exact_x))) / exact(bound)));
  }

 private:
  template <Scalar T>
  static T run(const Program<T>& program, const std::vector<T>& x) {
    std::vector<const T*> inputs;
    for (const T& value : x) inputs.push_back(&value);
    Matrix<T> registers = program.make_registers(1);
    program.run(registers, inputs);
    return program.output(0, 0, registers, inputs);
  }
  static Mpfr exact(const S& x) { return rounded_to<Mpfr>(raw(exactly(x))); }

  std::vector<S> constants_;
  std::vector<Instruction> code_;
  std::uint32_t temporaries_;
  Program<S> program_;
};

/// Every operation, on inputs that have been computed: no error is above the bound, and some are not far below.
TYPED_TEST(ProgramTest, BoundsWhatEveryOperationRounds) {
  using S = TypeParam;
  for (std::size_t n = 0; n < op_count; ++n) {
    const auto op = static_cast<Op>(n);
    if (op == Op::sign) continue;  // it has no error, away from 0
    const RoundingBound<S> bound({}, {{op, {Bank::input, 0}, {Bank::input, 1}, 0}}, 1);
    double worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<S> at{this->random.value(), this->random.value()};
      if (op == Op::sqrt || op == Op::log) at[0] = magnitude(at[0]);
      const double share = bound.share(at, {approximately(this->random.value()), approximately(this->random.value())});
      // The functions of double and Quad are right to a unit, of which a quotient is rounded once more.
      const bool is_ratio = op >= Op::sinc;
      EXPECT_LE(share, is_ratio ? 2 : 1) << name_of(op) << " at " << at[0] << ", " << at[1];
      worst = std::max(worst, share);
    }
    EXPECT_GE(worst, 1 / double{64}) << name_of(op);
  }
}

/// Twelve operations one after another on earlier results, of which some cancel.
TYPED_TEST(ProgramTest, BoundsWhatAProgramRounds) {
  using S = TypeParam;
  const Op ops[] = {Op::add,  Op::subtract, Op::multiply, Op::sin,  Op::cos,      Op::tanh,
                    Op::atan, Op::negate,   Op::multiply, Op::sinc, Op::subtract, Op::sinh};
  double greatest = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Instruction> code;
    constexpr std::uint32_t length = 12;
    for (std::uint32_t n = 0; n < length; ++n) {
      const auto operand = [&]() -> Operand {
        const auto from = static_cast<std::uint32_t>(this->random.whole(0, n + 2));
        if (from < 2) return {Bank::input, from};
        if (from == 2) return {Bank::constant, 0};
        return {Bank::temporary, from - 3};
      };
      // The last takes the one before, so that the chain has a length.
      const Operand first = n > 0 && n % 2 == 1 ? Operand{Bank::temporary, n - 1} : operand();
      code.push_back({ops[this->random.whole(0, 11)], first, operand(), n});
    }
    const RoundingBound<S> bound({S(this->random.value())}, code, length);
    double worst = 0;
    for (int point = 0; point < 8; ++point) {
      const double share = bound.share({this->random.value(), this->random.value()},
                                       {approximately(this->random.value()), approximately(this->random.value())});
      if (!(share >= 0)) continue;  // 0 by 0: the program is a constant 0
      EXPECT_LE(share, 1) << trial;
      worst = std::max(worst, share);
    }
    greatest = std::max(greatest, worst);
  }
  EXPECT_GE(greatest, 1 / double{16});
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
}  // namespace hbvm::core
