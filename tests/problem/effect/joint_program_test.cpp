#include "problem/effect/joint_program.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "printing.hpp"
#include "problem/effect/trace.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class JointProgramTest : public InDigits<50> {
 protected:
  using T = Traced<S>;
  RandomValues<S> random{83};

  /// The gradient of a formula for two inputs and a parameter, of which one coefficient comes.
  static Program<S> gradient(const std::function<T(const T& x, const T& y, const T& c)>& formula) {
    Trace<S> trace;
    const T x(trace, trace.input(0)), y(trace, trace.input(1)), c(trace, trace.parameter(0));
    return trace.compile(trace.gradient(formula(x, y, c).id(), 2), 2, 1).program;
  }
  static T distance(const T& x, const T& y) { return sqrt(x * x + y * y); }
  static std::vector<Program<S>> programs() {
    return {gradient([](const T& x, const T& y, const T& c) { return c / distance(x, y); }),
            gradient([](const T& x, const T& y, const T& c) { return c * cos(distance(x, y)); }),
            gradient([](const T& x, const T& y, const T& c) { return c * exp(x + y) - 3 * x; })};
  }
  static JointProgram<S> joint(const std::vector<Program<S>>& programs) {
    std::vector<JointPart<S>> parts;
    for (const Program<S>& program : programs) parts.push_back({&program, 1});
    return join(parts, 2);
  }
  /// The first outputs in each lane after so many instructions; inputs: lanes x number.
  static Matrix<S> outputs(const Program<S>& program, const Matrix<S>& inputs, Index count, std::size_t end) {
    std::vector<const S*> columns;
    for (Index j = 0; j < inputs.cols(); ++j) columns.push_back(inputs.data() + j * inputs.rows());
    Matrix<S> registers = program.make_registers(inputs.rows()), result(inputs.rows(), count);
    program.run(registers, columns, 0, end);
    for (Index j = 0; j < count; ++j)
      for (Index i = 0; i < inputs.rows(); ++i)
        result(i, j) = program.output(static_cast<std::size_t>(j), i, registers, columns);
    return result;
  }
};
TYPED_TEST_SUITE(JointProgramTest, AllScalars, ScalarNames);

/// To the last bit, whatever comes after; and each has its own coefficient.
TYPED_TEST(JointProgramTest, HasTheOutputsOfEachAfterItsInstructions) {
  using S = TypeParam;
  const std::vector<Program<S>> programs = this->programs();
  const JointProgram<S> joint = this->joint(programs);
  const Matrix<S> inputs = this->random.matrix(4, 5);  // x, y and three coefficients
  Matrix<S> expected(4, 0);
  for (Index n = 0; n < 3; ++n) {
    Matrix<S> own(4, 3);
    own << inputs.leftCols(2), inputs.col(2 + n);
    const Program<S>& program = programs[static_cast<std::size_t>(n)];
    expected.conservativeResize(4, 2 * n + 2);
    expected.rightCols(2) = this->outputs(program, own, 2, program.instructions().size());
    EXPECT_EQ(this->outputs(joint.program, inputs, 2 * n + 2, joint.ends[static_cast<std::size_t>(n)]), expected) << n;
  }
}

/// Distance and reciprocal are the first one's. The second adds a sine, its product with the reciprocal, that with the
/// coefficient, and one for each component. The third has nothing in common with them.
TYPED_TEST(JointProgramTest, ComputesOnceWhatTheyHaveInCommon) {
  using S = TypeParam;
  const std::vector<Program<S>> programs = this->programs();
  const JointProgram<S> joint = this->joint(programs);
  EXPECT_EQ(joint.program.operations(0, joint.ends[0]), programs[0].operations());
  OperationCounts added;
  added.add(Op::sin, 1);
  added.add(Op::multiply, 4);
  EXPECT_EQ(joint.program.operations(joint.ends[0], joint.ends[1]), added);
  EXPECT_EQ(joint.program.operations(joint.ends[1], joint.ends[2]), programs[2].operations());
  EXPECT_EQ(joint.ends[2], joint.program.instructions().size());
}

/// The same program twice: what it does is free of the coefficient but for a product with it and one for each
/// component.
TYPED_TEST(JointProgramTest, OfTwoAlikeTheSecondIsNearlyFree) {
  using S = TypeParam;
  std::vector<Program<S>> programs(2, this->programs()[0]);
  OperationCounts added;
  added.add(Op::multiply, 3);
  const JointProgram<S> joint = this->joint(programs);
  EXPECT_EQ(joint.program.operations(joint.ends[0], joint.ends[1]), added);
}

TYPED_TEST(JointProgramTest, OneAloneIsItself) {
  using S = TypeParam;
  for (const Program<S>& program : this->programs()) {
    const JointProgram<S> joint = this->joint({program});
    EXPECT_EQ(joint.program.operations(), program.operations());
    EXPECT_EQ(joint.program.temporaries(), program.temporaries());
  }
}

}  // namespace
}  // namespace hbvm::core
