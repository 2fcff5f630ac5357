#include "problem/effect/compile.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/effect/execution.hpp"

namespace hbvm::core {
namespace {

/// U = c x y^2 for two instances, c = 2 and 5.
TEST(Compile, FillsInValueAndDerivatives) {
  Trace<double> trace;
  const Traced<double> x(trace, trace.input(0)), y(trace, trace.input(1)), c(trace, trace.parameter(0));
  EffectTerm<double> term;
  compile(trace, (c * x * y * y).id(), 2, 1, {{2}, {5}}, term);
  EXPECT_EQ(term.degree, 3);
  EXPECT_FALSE(term.constant_force);
  Matrix<double> at(2, 2);
  at << 3, 7, 1, -2;
  Execution<double> value(term.value, term.value_coefficients, at, 1),
      gradient(term.gradient, term.gradient_coefficients, at, 1),
      hessian(term.hessian, term.hessian_coefficients, at, 1);
  value.run();
  gradient.run();
  hessian.run();
  EXPECT_EQ(value.output(0, 0), 2 * 3 * 49);
  EXPECT_EQ(value.output(0, 1), 5 * 4);
  EXPECT_EQ(gradient.output(0, 1), 5 * 4);
  EXPECT_EQ(gradient.output(1, 0), 2 * 2 * 3 * 7);
  EXPECT_EQ(hessian.output(0, 0), 0);
  EXPECT_EQ(hessian.output(1, 1), 2 * 5 * -2);
  EXPECT_EQ(hessian.output(2, 0), 2 * 2 * 3);
}

TEST(Compile, KnowsAConstantForce) {
  Trace<double> trace;
  const Traced<double> x(trace, trace.input(0)), c(trace, trace.parameter(0));
  EffectTerm<double> term;
  compile(trace, (c * x - c).id(), 1, 1, {{2}}, term);
  EXPECT_TRUE(term.constant_force);
  EXPECT_EQ(term.degree, 1);
}

/// Products of sums of very many inputs have very many second derivatives.
TEST(Compile, RefusesWhatTakesTooManyOperations) {
  Trace<double> trace;
  constexpr std::size_t inputs = 900;
  Traced<double> product(trace, trace.input(0));
  for (std::size_t i = 1; i < inputs; ++i) product = product * sin(Traced<double>(trace, trace.input(i)));
  EffectTerm<double> term;
  EXPECT_THROW(compile(trace, product.id(), inputs, 0, {{}}, term), InputError);
}

}  // namespace
}  // namespace hbvm::core
