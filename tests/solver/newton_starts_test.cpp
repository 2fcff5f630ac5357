#include "solver/newton_starts.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

template <class S>
class NewtonStartsTest : public InDigits<50> {};
TYPED_TEST_SUITE(NewtonStartsTest, AllScalars, ScalarNames);

/// Solutions that change by the same from step to step, of few stages: the sequence continues.
TYPED_TEST(NewtonStartsTest, ContinueTheLastSteps) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(1, 1);
  const StageEquations<S> equations(scene.problem, method);
  StageUnknowns<S> x = equations.make_unknowns();
  NewtonStarts<S> starts(scene.problem, method, x);
  EXPECT_FALSE(starts.known());
  for (int n = 0; n < 4; ++n) {
    x.gamma.setConstant(S(5 + n));
    x.lambda.setConstant(S(7 - 2 * n));
    starts.keep(x);
  }
  ASSERT_TRUE(starts.known());
  starts.predict(x);
  EXPECT_EQ(x.gamma, Matrix<S>::Constant(1, 4, S(9)));
  EXPECT_EQ(x.lambda, Matrix<S>::Constant(1, 2, S(-1)));
  EXPECT_EQ(starts.part_counts()[0].calls, 4u);
  starts.clear();
  EXPECT_FALSE(starts.known());
}

/// v = p0 everywhere, with multipliers that a sweep from there would have.
TYPED_TEST(NewtonStartsTest, AreElseTheConstantMomentum) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(3, 2);
  StageEquations<S> equations(scene.problem, method);
  const S h = S(1) / 16;
  equations.start({scene.q0, scene.p0, h});
  StageUnknowns<S> x = equations.make_unknowns();
  x.gamma.setConstant(S(3));
  x.lambda.setConstant(S(3));
  NewtonStarts<S>::set_constant(equations, x);
  EXPECT_EQ(x.gamma.row(0).transpose(), scene.p0);
  EXPECT_EQ(x.gamma.row(1), (Matrix<S>::Zero(1, 4)));

  Matrix<S> psi = x.psi, zeta = x.zeta, lambda = Matrix<S>::Zero(2, 2);
  equations.move(x.gamma);
  equations.forces(psi);
  ASSERT_TRUE(equations.multipliers(psi, lambda, zeta));
  EXPECT_EQ(x.lambda, lambda);
}

}  // namespace
}  // namespace hbvm::core
