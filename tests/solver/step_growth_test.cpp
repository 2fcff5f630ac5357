#include "solver/step_growth.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"
#include "solver/newton_starts.hpp"

namespace hbvm::core {
namespace {

template <class S>
class StepGrowthTest : public InDigits<50> {};
TYPED_TEST_SUITE(StepGrowthTest, AllScalars, ScalarNames);

/// Where v = p0 leads to the solution, shorter steps lead to the same.
TYPED_TEST(StepGrowthTest, LeadsToTheSolutionOfTheWholeStep) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(3, 2);
  const S h = S(1) / 16;
  const StepStart<S> from{scene.q0, scene.p0, h};
  NewtonIteration<S> iteration(scene.problem, method, NewtonIteration<S>::Wanted::solution);
  iteration.begin(from, h);
  NewtonStarts<S>::set_constant(iteration.equations(), iteration.unknowns());
  const long at_once = iteration.run();
  const Matrix<S> gamma = iteration.unknowns().gamma;

  BranchGuard<S> guard(scene.problem, method);
  const long sweeps = grow(iteration, guard, from, 12);
  EXPECT_GT(sweeps, 12 + at_once);  // a step of 2^-12 at first, and at most twice as long each
  EXPECT_EQ(iteration.equations().step(), h);
  EXPECT_LE(max_norm(Matrix<S>(iteration.unknowns().gamma - gamma)), S(64 * epsilon<S>() * max_norm(gamma)));
}

}  // namespace
}  // namespace hbvm::core
