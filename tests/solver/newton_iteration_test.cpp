#include "solver/newton_iteration.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"
#include "solver/newton_starts.hpp"

namespace hbvm::core {
namespace {

template <class S>
class NewtonIterationTest : public InDigits<50> {};
TYPED_TEST_SUITE(NewtonIterationTest, AllScalars, ScalarNames);

/// From v = p0 it leads to unknowns that leave nothing of the equations, and from there to the same.
TYPED_TEST(NewtonIterationTest, LeadsToASolutionAndStaysThere) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "bead_on_ellipsoid", "tethered_satellites"})
    for (const auto& [k, s] : {std::pair(1, 1), {4, 3}}) {
      const Assembled<S> scene = assemble<S>(load_scene(name));
      const Hbvm<S> method = make_hbvm<S>(k, s);
      NewtonIteration<S> iteration(scene.problem, method, NewtonIteration<S>::Wanted::solution);
      const S h = S(1) / 16;
      iteration.begin({scene.q0, scene.p0, h}, h);
      NewtonStarts<S>::set_constant(iteration.equations(), iteration.unknowns());
      const Matrix<S> gamma = iteration.unknowns().gamma;
      const long sweeps = iteration.run();
      EXPECT_GT(sweeps, 2) << name;
      EXPECT_EQ(iteration.start().gamma, gamma) << name;
      EXPECT_EQ(iteration.equations_count().calls, static_cast<std::uint64_t>(sweeps)) << name;

      StageUnknowns<S> x = iteration.unknowns();
      StageResidual<S> residual{x.gamma, x.lambda};
      iteration.equations().residual(x, residual);
      EXPECT_LE(max_norm(residual.momentum), S(64 * epsilon<S>() * max_norm(x.gamma))) << name << ", s = " << s;
      iteration.run();
      EXPECT_LE(max_norm(Matrix<S>(iteration.unknowns().gamma - x.gamma)), S(64 * epsilon<S>() * max_norm(x.gamma)))
          << name << ", s = " << s;
    }
}

/// A Jacobian that is forgotten is evaluated anew, one that is not serves again.
TYPED_TEST(NewtonIterationTest, KeepsItsJacobian) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(2, 2);
  NewtonIteration<S> iteration(scene.problem, method, NewtonIteration<S>::Wanted::solution);
  const S h = S(1) / 64;
  iteration.begin({scene.q0, scene.p0, h}, h);
  NewtonStarts<S>::set_constant(iteration.equations(), iteration.unknowns());
  const auto evaluations = [&] { return iteration.jacobian().part_counts()[0].calls; };
  iteration.run();
  const auto first = evaluations();
  EXPECT_GE(first, 1u);
  iteration.run();
  EXPECT_EQ(evaluations(), first);
  iteration.forget_jacobian();
  iteration.run();
  EXPECT_EQ(evaluations(), first + 1);
}

}  // namespace
}  // namespace hbvm::core
