#include "solver/simplified_newton.hpp"

#include <csignal>

#include "interrupting.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"
#include "solver/error_of.hpp"
#include "solver/falling_stone.hpp"
#include "step/state.hpp"

namespace hbvm::core {
namespace {

template <class S>
class SimplifiedNewtonTest : public InDigits<50> {
 protected:
  static S distance(const Matrix<S>& a, const Matrix<S>& b) { return max_norm(Matrix<S>(a - b)); }
};
TYPED_TEST_SUITE(SimplifiedNewtonTest, AllScalars, ScalarNames);

/// As the paper's iteration finds it, from whichever start.
TYPED_TEST(SimplifiedNewtonTest, FindsTheSolution) {
  using S = TypeParam;
  const S h = S(1) / 16;
  for (const char* const name : {"kepler", "double_pendulum", "bead_on_ellipsoid"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const Hbvm<S> method = make_hbvm<S>(4, 2);
    const auto papers = make_solver(SolverKind::paper, scene.problem, method);
    papers->solve({scene.q0, scene.p0, h});
    const StageUnknowns<S>& expected = papers->unknowns();
    const S tolerance = 2000 * epsilon<S>();
    SimplifiedNewton<S> newton(scene.problem, method);
    newton.solve({scene.q0, scene.p0, h});
    EXPECT_LE(this->distance(newton.unknowns().gamma, expected.gamma), tolerance) << name;
    EXPECT_LE(this->distance(newton.unknowns().lambda, expected.lambda), tolerance / h) << name;
    if constexpr (std::same_as<S, double>) {
      EXPECT_TRUE(newton.refresh(newton.equations()));
    }
    // The start is now that of the last step, and the Jacobian that of the solution.
    newton.solve({scene.q0, scene.p0, h});
    EXPECT_LE(this->distance(newton.unknowns().gamma, expected.gamma), tolerance) << name;
    newton.follow({scene.q0, scene.p0, h});
    EXPECT_LE(this->distance(newton.unknowns().gamma, expected.gamma), tolerance) << name;
  }
}

/// A body next to a centre of gravity falls into it within the step.
TYPED_TEST(SimplifiedNewtonTest, FailsWithACause) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(falling_stone("1e-9"));
  const Hbvm<S> method = make_hbvm<S>(2, 2);
  SimplifiedNewton<S> newton(scene.problem, method);
  const S h = 1;
  const auto failure = error_of<StageFailure>([&] { newton.solve({scene.q0, scene.p0, h}); });
  EXPECT_EQ(failure.cause(), FailureCause::stage_equations_diverge) << failure.what();
  EXPECT_GT(failure.sweeps(), 0);
}

/// An ordinary step is finished first.
TEST(SimplifiedNewton, IsEndedByASignalBetweenShorterSteps) {
  const Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  const Hbvm<double> method = make_hbvm<double>(2, 2);
  SimplifiedNewton<double> newton(scene.problem, method);
  const double h = 1.0 / 64;
  interruption = SIGTERM;
  EXPECT_NO_THROW(newton.solve({scene.q0, scene.p0, h}));
  EXPECT_THROW(newton.follow({scene.q0, scene.p0, h}), Interrupted);
  interruption = 0;
}

/// Two satellites are at rest, and the pull of the third one alone tells how far they may move. Beside the multipliers
/// of a long step it would hardly be felt: they are no measure in a short one.
TEST(SimplifiedNewton, MakesALongFirstStepFromRest) {
  const Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  for (const int s : {5, 12, 22})
    for (const double step : {2.0 / 7, 1.0 / 3, 1.0 / 2}) {
      const Hbvm<double> method = make_hbvm<double>(s, s);
      SimplifiedNewton<double> newton(scene.problem, method);
      EXPECT_NO_THROW(newton.solve({scene.q0, scene.p0, step})) << s << ", " << step;
    }
}

/// However expensive a Jacobian is, increments that hardly fall are worth one. In each of these runs the last step's
/// serves for some sweeps, and steps have one evaluation in the mean or few more.
TEST(SimplifiedNewton, EvaluatesTheJacobianWhereItPays) {
  const Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  long sweeps = 0;
  const auto evaluations = [&](int s, double h, int steps) {
    const Hbvm<double> method = make_hbvm<double>(s, s);
    SimplifiedNewton<double> newton(scene.problem, method);
    State<double> state(scene.q0, scene.p0);
    sweeps = 0;
    for (int n = 0; n < steps; ++n) {
      sweeps += newton.solve({state.q, state.p, h, &state.q_carry, &state.p_carry});
      for (Index j = 0; j < state.q.size(); ++j) {
        state.q[j] += newton.change().q[j];
        state.p[j] += newton.change().p[j];
      }
    }
    return static_cast<double>(newton.jacobian().part_counts().front().calls) / steps;
  };
  const double cheap = evaluations(1, 1.0 / 4, 40), expensive = evaluations(20, 1.0 / 4, 40);
  EXPECT_LT(expensive, 2);
  EXPECT_GT(expensive, 0);
  EXPECT_GT(cheap, expensive);
  // By updates of rank one an old Jacobian takes some thirty; without them, more than fifty.
  EXPECT_LT(sweeps, 40 * 40);
}

}  // namespace
}  // namespace hbvm::core
