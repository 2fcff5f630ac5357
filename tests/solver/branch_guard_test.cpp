#include "solver/branch_guard.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

template <class S>
class BranchGuardTest : public InDigits<50> {};
TYPED_TEST_SUITE(BranchGuardTest, AllScalars, ScalarNames);

/// A pendulum of mass 1 at (0, -1) with p0 = (1, 0): where forces are small, |p0| = 1 is the size of what may change.
TYPED_TEST(BranchGuardTest, SeesMomentaForcesAndMultipliersThatLeaveTheStart) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("simple_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(2, 2);
  const S h = S(1) / 8;
  StageEquations<S> equations(scene.problem, method);
  equations.start({scene.q0, scene.p0, h});
  StageUnknowns<S> start = equations.make_unknowns();
  start.gamma.row(0) = scene.p0.transpose();
  StageResidual<S> residual{start.gamma, start.lambda};
  equations.residual(start, residual);
  BranchGuard<S> guard(scene.problem, method);
  guard.start(equations, start);

  StageUnknowns<S> x = start;
  EXPECT_FALSE(guard.is_far(x));
  EXPECT_FALSE(guard.multipliers_run_wild(x));
  x.gamma(1, 1) = S(7) / 8;
  EXPECT_FALSE(guard.is_far(x));
  x.gamma(1, 1) = S(9) / 8;
  EXPECT_TRUE(guard.is_far(x));

  x = start;
  x.psi(1, 0) += S(7) / (16 * h);  // h psi by nearly half
  EXPECT_FALSE(guard.is_far(x));
  x.psi(1, 0) += S(2) / (16 * h);
  EXPECT_TRUE(guard.is_far(x));

  // The gradient is about (0, -2): h 2 lambda by less than 4, and by more.
  x = start;
  x.lambda(0, 0) += S(15) / (8 * h);
  EXPECT_FALSE(guard.multipliers_run_wild(x));
  x.lambda(0, 0) += S(2) / (8 * h);
  EXPECT_TRUE(guard.multipliers_run_wild(x));
  EXPECT_FALSE(guard.is_far(x));
}

}  // namespace
}  // namespace hbvm::core
