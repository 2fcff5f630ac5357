#include "solver/root_check.hpp"

#include "printing.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

/// A body on a circle whose period is about four steps of 250.
const char* const slow_circle = R"(
dimension = 2
body = [{ name = "b", mass = 1, position = ["-10.772", "-8.4499"], velocity = ["-0.00768280410480453294195", "0.0097941000268588301460"] }]
constraint = [{ kind = "quadric", body = "b", A = [[1, 0], [0, 1]], b = [0, 0], c = "-187.43679401" }]
effect = [{ kind = "uniform_gravity", acceleration = ["9.272e-04", "2.940e-04"] }]
)";

template <class S>
class Roots : public InDigits<50> {};
TYPED_TEST_SUITE(Roots, AllScalars, ScalarNames);

TYPED_TEST(Roots, AreToldApart) {
  using S = TypeParam;
  using Verdict = typename RootCheck<S>::Verdict;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(4, 2);
  const S h = S(1) / 8;
  const auto solver = make_solver<S>(SolverKind::newton, scene.problem, method);
  solver->solve({scene.q0, scene.p0, h});
  RootCheck<S> check(scene.problem, method);
  Matrix<S> gamma = solver->unknowns().gamma;
  EXPECT_EQ(check.judge({scene.q0, scene.p0, h}, gamma), Verdict::same);
  EXPECT_GT(check.sweeps(), 0);
  gamma(0, 3) += S(1) / 64;
  EXPECT_EQ(check.judge({scene.q0, scene.p0, h}, gamma), Verdict::other);
}

TYPED_TEST(Roots, OfMassesBeyondDoubleAreUnknown) {
  using S = TypeParam;
  if constexpr (std::same_as<S, double>) return;
  Assembled<S> scene = assemble<S>(read_scene(
      "dimension = 2\nbody = [{ name = \"b\", mass = \"2^-1100\", position = [0, 0], velocity = [1, 0] }]\n", "light"));
  const Hbvm<S> method = make_hbvm<S>(1, 1);
  RootCheck<S> check(scene.problem, method);
  EXPECT_EQ(check.judge({scene.q0, scene.p0, S(1)}, Matrix<S>::Zero(1, 2)), RootCheck<S>::Verdict::unknown);
}

/// In double the fixed point converges to a solution on the other side of the circle in the second step.
TEST(RootsOfTheFixedPoint, AreThoseOfShorterStepsOrNone) {
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::paper, SolverKind::automatic}) {
    SceneSteps<double> run(read_scene(slow_circle, "slow"), "hbvm:3,3", kind),
        newton(read_scene(slow_circle, "slow"), "hbvm:3,3", SolverKind::newton);
    try {
      for (int n = 0; n < 4; ++n) {
        run.step(250);
        newton.step(250);
        for (Index i = 0; i < 2; ++i)
          EXPECT_NEAR(run.state.q[i], newton.state.q[i], 1e-10) << name_of(kind) << " " << n;
      }
      EXPECT_EQ(kind, SolverKind::automatic) << "it should not get so far";
    } catch (const StageFailure& failure) {
      EXPECT_NE(kind, SolverKind::automatic) << failure.what();
      EXPECT_EQ(failure.cause(), FailureCause::stage_equations_diverge);
    }
  }
}

}  // namespace
}  // namespace hbvm::core
