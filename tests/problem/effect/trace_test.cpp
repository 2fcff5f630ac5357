#include "problem/effect/trace.hpp"

#include <cmath>
#include <optional>

#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Runs a compiled formula: inputs and parameters are lanes x number.
template <Scalar S>
Matrix<S> run(const typename Trace<S>::Compiled& compiled, const Matrix<S>& inputs, const Matrix<S>& parameters) {
  const Index lanes = inputs.rows();
  const auto columns = [](const Matrix<S>& a) {
    std::vector<const S*> result;
    for (Index j = 0; j < a.cols(); ++j) result.push_back(a.data() + j * a.rows());
    return result;
  };
  const auto outputs = [&](const Program<S>& program, const std::vector<const S*>& in) {
    Matrix<S> registers = program.make_registers(lanes), out(lanes, static_cast<Index>(program.outputs()));
    program.run(registers, in);
    for (Index j = 0; j < out.cols(); ++j)
      for (Index i = 0; i < lanes; ++i) out(i, j) = program.output(static_cast<std::size_t>(j), i, registers, in);
    return out;
  };
  const Matrix<S> coefficients = outputs(compiled.coefficients, columns(parameters));
  std::vector<const S*> all = columns(inputs);
  for (const S* column : columns(coefficients)) all.push_back(column);
  return outputs(compiled.program, all);
}

/// A random formula that has a value and derivatives for all arguments, over whatever number type.
class Tree {
 public:
  template <Scalar S>
  Tree(RandomValues<S>& random, int depth, int leaves) : kind_(static_cast<int>(random.whole(0, 19))) {
    if (depth == 0) {
      kind_ = leaf;
      index_ = static_cast<std::size_t>(random.whole(0, leaves - 1));
      return;
    }
    children_.emplace_back(random, depth - 1, leaves);
    children_.emplace_back(random, random.whole(0, 3) == 0 ? 0 : depth - 1, leaves);
  }

  template <class T>
  T value(const std::vector<T>& leaves) const {
    using std::abs, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tanh;
    if (kind_ == leaf) return leaves[index_];
    const T a = children_[0].value(leaves), b = children_[1].value(leaves);
    switch (kind_) {
      case 0:
      case 1:
        return a + b;
      case 2:
      case 3:
        return a - b;
      case 4:
      case 5:
      case 6:
        return a * b;
      case 7:
        return a / (b * b + 1);
      case 8:
        return -a;
      case 9:
        return sqrt(a * a + 1) - 2 * b;
      case 10:
        return sin(a) + b;
      case 11:
        return cos(a) * b;
      case 12:
        return exp(T(sin(a))) - b / 3;
      case 13:
        return log(a * a + 2);
      case 14:
        return abs(a) - 1;
      case 16:
        return sinh(T(cos(a))) * b;
      case 17:
        return cosh(T(sin(a))) - b;
      case 18:
        return tanh(a) + b;
      case 19:
        return atan(a) * b;
      default:
        return 1 / (a * a + 2) + b;
    }
  }

 private:
  static constexpr int leaf = -1;
  int kind_;
  std::size_t index_ = 0;
  std::vector<Tree> children_;
};

/// Three inputs, two parameters and the constants 0, 1, -1, 2 and 1/3 as leaves.
class RandomFormulas : public InDigits<60> {
 protected:
  static constexpr std::size_t inputs = 3, parameters = 2, leaves = 10;
  static constexpr Index count = 3;
  RandomValues<Mpfr> random{61};
  std::vector<Mpfr> constants{Mpfr(0), Mpfr(1), Mpfr(-1), Mpfr(2), Mpfr(Mpfr(1) / 3)};

  Mpfr at(const Tree& tree, const Vector<Mpfr>& x, const Vector<Mpfr>& p) const {
    std::vector<Mpfr> values(x.begin(), x.end());
    values.insert(values.end(), p.begin(), p.end());
    values.insert(values.end(), constants.begin(), constants.end());
    return tree.value(values);
  }

  struct Recorded {
    Trace<Mpfr>::Compiled value, gradient;
  };
  Recorded record(const Tree& tree) const {
    Trace<Mpfr> trace;
    std::vector<Traced<Mpfr>> values;
    for (std::size_t i = 0; i < inputs; ++i) values.emplace_back(trace, trace.input(i));
    for (std::size_t i = 0; i < parameters; ++i) values.emplace_back(trace, trace.parameter(i));
    for (const Mpfr& c : constants) values.emplace_back(trace, trace.constant(c));
    const auto output = tree.value(values).id();
    const auto gradient = trace.gradient(output, inputs);
    return {trace.compile({output}, inputs, parameters), trace.compile(gradient, inputs, parameters)};
  }
};

TEST_F(RandomFormulas, HaveTheValuesOfDirectEvaluation) {
  for (int trial = 0; trial < 300; ++trial) {
    const Tree tree(random, 1 + trial % 5, leaves);
    const auto recorded = record(tree);
    const Matrix<Mpfr> x = random.matrix(count, inputs), p = random.matrix(count, parameters);
    const Matrix<Mpfr> U = run<Mpfr>(recorded.value, x, p);
    for (Index i = 0; i < count; ++i) {
      const Mpfr expected = at(tree, x.row(i).transpose(), p.row(i).transpose());
      // Coefficients move outwards, which changes the roundings; a few hundred operations may amplify them.
      EXPECT_LE(magnitude(Mpfr(U(i, 0) - expected)), literal<Mpfr>("1e-50") * (1 + magnitude(expected))) << trial;
    }
  }
}

TEST_F(RandomFormulas, HaveTheGradientsOfFiniteDifferences) {
  const Mpfr h = literal<Mpfr>("1e-20");
  for (int trial = 0; trial < 300; ++trial) {
    const Tree tree(random, 1 + trial % 5, leaves);
    const auto recorded = record(tree);
    const Matrix<Mpfr> x = random.matrix(count, inputs), p = random.matrix(count, parameters);
    const Matrix<Mpfr> gradient = run<Mpfr>(recorded.gradient, x, p);
    for (Index i = 0; i < count; ++i) {
      for (Index j = 0; j < gradient.cols(); ++j) {
        Vector<Mpfr> before = x.row(i).transpose(), after = before;
        before[j] -= h;
        after[j] += h;
        const Vector<Mpfr> parameter = p.row(i).transpose();
        const Mpfr expected = (at(tree, after, parameter) - at(tree, before, parameter)) / (2 * h);
        // h^2 and the 60 digits over h leave 40 digits for derivatives of order 1.
        EXPECT_LE(magnitude(Mpfr(gradient(i, j) - expected)), literal<Mpfr>("1e-30") * (1 + magnitude(expected)))
            << trial << ", component " << j;
      }
    }
  }
}

template <class S>
class TraceTest : public InDigits<50> {
 protected:
  using T = Traced<S>;
  RandomValues<S> random{67};
  Trace<S> trace;
  T x{trace, trace.input(0)}, y{trace, trace.input(1)}, z{trace, trace.input(2)};
  T parameter{trace, trace.parameter(0)};

  T constant(const S& value) { return {trace, trace.constant(value)}; }

  OperationCounts operations(const std::vector<T>& outputs) { return program(outputs).operations(); }
  Program<S> program(const std::vector<T>& outputs) {
    std::vector<typename Trace<S>::Id> ids;
    for (const T& output : outputs) ids.push_back(output.id());
    return trace.compile(ids, 3, 1).program;
  }
  Program<S> gradient(const T& output, std::size_t inputs) {
    return trace.compile(trace.gradient(output.id(), inputs), inputs, 1).program;
  }
};
TYPED_TEST_SUITE(TraceTest, AllScalars, ScalarNames);

OperationCounts counts(std::initializer_list<std::pair<Op, Index>> entries) {
  OperationCounts result;
  for (const auto& [op, n] : entries) result.add(op, n);
  return result;
}

TYPED_TEST(TraceTest, GradientOfOneOverRDoesWhatOneWouldWriteByHand) {
  // w = 1/sqrt(x x + y y), f = -(w w w), f x, f y
  EXPECT_EQ(this->gradient(1 / sqrt(this->x * this->x + this->y * this->y), 2).operations(),
            counts({{Op::multiply, 6}, {Op::add, 1}, {Op::sqrt, 1}, {Op::reciprocal, 1}, {Op::negate, 1}}));
}

TYPED_TEST(TraceTest, FactorsMeetInOneCoefficient) {
  // c/sqrt(x x + y y): the sign joins the coefficient, f = (-c) (w w w).
  const auto c = this->parameter * this->constant(TypeParam(3));
  EXPECT_EQ(this->gradient(c / sqrt(this->x * this->x + this->y * this->y), 2).operations(),
            counts({{Op::multiply, 7}, {Op::add, 1}, {Op::sqrt, 1}, {Op::reciprocal, 1}}));
}

TYPED_TEST(TraceTest, GradientOfAQuadraticFormIsOneProductAComponent) {
  const auto square = this->x * this->x + this->y * this->y + this->z * this->z;
  EXPECT_EQ(this->gradient(-(this->parameter / 2 * square), 3).operations(), counts({{Op::multiply, 3}}));
}

TYPED_TEST(TraceTest, GradientOfALinearFormIsConstant) {
  const auto program = this->gradient(2 * this->x - this->constant(TypeParam(5)) * this->y, 3);
  EXPECT_EQ(program.operations().total(), 0u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(program.is_constant(i));
  Matrix<TypeParam> registers = program.make_registers(1);
  const TypeParam expected[] = {TypeParam(2), TypeParam(-5), TypeParam(0)};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(program.output(i, 0, registers, {}), expected[i]);
}

TYPED_TEST(TraceTest, FoldsConstants) {
  const auto two = this->constant(TypeParam(2)), four = this->constant(TypeParam(4));
  const auto folded = {sqrt(four),       two * two - two,  four / two,       abs(-two),       4 / two,
                       exp(two - 2) + 1, log(two - 1) + 2, sin(two - 2) + 2, cos(two - 2) + 1};
  for (const auto& value : folded) {
    const auto program = this->program({value});
    EXPECT_TRUE(program.is_constant(0));
    EXPECT_EQ(program.output(0, 0, program.make_registers(1), {}), 2);
  }
}

TYPED_TEST(TraceTest, NeutralElementsCostNothing) {
  const auto zero = this->constant(TypeParam(0)), one = this->constant(TypeParam(1));
  for (const auto& same : {this->x + zero, zero + this->x, this->x - zero, this->x * one, one * this->x, this->x / 1,
                           this->x + 0, 1 * this->x, -(-this->x)})
    EXPECT_EQ(same.id(), this->x.id());
  for (const auto& nothing : {this->x * zero, zero * this->x, this->x - this->x, 0 * this->x})
    EXPECT_EQ(nothing.id(), zero.id());
}

TYPED_TEST(TraceTest, EqualOperationsAreDoneOnce) {
  EXPECT_EQ((this->x * this->y).id(), (this->y * this->x).id());
  EXPECT_EQ((this->x + this->y).id(), (this->y + this->x).id());
  EXPECT_EQ(sin(this->x * this->y).id(), sin(this->y * this->x).id());
  EXPECT_NE((this->x - this->y).id(), (this->y - this->x).id());
  EXPECT_EQ(this->operations({sin(this->x) * this->y + sin(this->x) * this->z}),
            counts({{Op::sin, 1}, {Op::multiply, 2}, {Op::add, 1}}));
}

TYPED_TEST(TraceTest, WhatDependsOnParametersAloneIsComputedBefore) {
  const auto compiled = this->trace.compile({(sqrt(this->parameter) * this->x).id()}, 3, 1);
  EXPECT_EQ(compiled.program.operations(), counts({{Op::multiply, 1}}));
  EXPECT_EQ(compiled.coefficients.operations(), counts({{Op::sqrt, 1}}));
  EXPECT_EQ(compiled.coefficients.outputs(), 1u);
}

TYPED_TEST(TraceTest, OutputsMayBeInputsParametersAndConstants) {
  const auto compiled =
      this->trace.compile({this->y.id(), this->parameter.id(), this->constant(TypeParam(9)).id()}, 3, 1);
  const Matrix<TypeParam> inputs = this->random.matrix(2, 3), parameters = this->random.matrix(2, 1);
  const Matrix<TypeParam> out = run<TypeParam>(compiled, inputs, parameters);
  for (Index i = 0; i < 2; ++i) {
    EXPECT_EQ(out(i, 0), inputs(i, 1));
    EXPECT_EQ(out(i, 1), parameters(i, 0));
    EXPECT_EQ(out(i, 2), 9);
  }
}

TYPED_TEST(TraceTest, DegreeOfPolynomials) {
  const auto degree = [&](const Traced<TypeParam>& value) { return this->trace.degree(value.id()); };
  EXPECT_EQ(degree(this->constant(TypeParam(3))), 0);
  EXPECT_EQ(degree(this->parameter), 0);
  EXPECT_EQ(degree(sqrt(this->parameter)), 0);
  EXPECT_EQ(degree(this->x), 1);
  EXPECT_EQ(degree(this->x * this->y - this->z), 2);
  EXPECT_EQ(degree(this->parameter * this->x * this->x * this->y), 3);
  EXPECT_EQ(degree((this->x * this->y) * (this->x * this->y) / 7), 4);
  EXPECT_EQ(degree(this->x - this->x), 0);
  for (const auto& no_polynomial : {sqrt(this->x), 1 / this->x, sin(this->x) * this->y, abs(this->x), exp(this->x) + 1,
                                    log(this->x) - this->y, cos(this->y) * cos(this->y)})
    EXPECT_EQ(degree(no_polynomial), Trace<TypeParam>::not_polynomial);
}

TYPED_TEST(TraceTest, GradientByAnInputThatDoesNotOccurIsZero) {
  const auto program = this->gradient(sin(this->x), 3);
  EXPECT_FALSE(program.is_constant(0));
  for (const std::size_t i : {1u, 2u}) {
    ASSERT_TRUE(program.is_constant(i));
    EXPECT_EQ(program.output(i, 0, program.make_registers(1), {}), 0);
  }
}

TYPED_TEST(TraceTest, GradientOfAnInputItself) {
  const auto program = this->gradient(this->y, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(program.is_constant(i));
    EXPECT_EQ(program.output(i, 0, program.make_registers(1), {}), i == 1 ? 1 : 0);
  }
}

TYPED_TEST(TraceTest, RegistersAreReused) {
  auto sum = sin(this->x);
  for (int i = 0; i < 50; ++i) sum = sin(sum * this->y);
  EXPECT_LE(this->program({sum}).make_registers(1).cols(), 2);
}

}  // namespace
}  // namespace hbvm::core
