#include "step/backward_stepper.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Backward : public InDigits<50> {};
TYPED_TEST_SUITE(Backward, AllScalars, ScalarNames);

/// The methods are symmetric.
TYPED_TEST(Backward, ComesBackToRoundOff) {
  using S = TypeParam;
  for (const char* scene : {"charged_double_pendulum", "heavy_top", "kepler"}) {
    SceneRun<S> run(load_scene(scene), 3, 2, "1/64", "1", SolverKind::automatic);
    const State<S> start = run.state;
    for (int n = 0; n < 64; ++n) run.step();
    EXPECT_GT(distance(run.state.q, start.q), S(1) / 100);
    SceneRun<S> back(load_scene(scene), 3, 2, "1/64", "1", SolverKind::automatic);
    BackwardStepper<S> stepper(back.stepper);
    for (int n = 0; n < 64; ++n) stepper.step(run.state, back.grid.step());
    EXPECT_LE(distance(run.state.q, start.q), 1'000 * epsilon<S>()) << scene;
    EXPECT_LE(distance(run.state.p, start.p), 1'000 * epsilon<S>()) << scene;
  }
}

TYPED_TEST(Backward, ReversesTheCarryToo) {
  using S = TypeParam;
  const Scene scene = load_scene("charged_double_pendulum");
  SceneRun<S> run(scene, 3, 2, "1/64", "1"), other(scene, 3, 2, "1/64", "1");
  State<S>&state = run.state, &reversed = other.state;
  for (State<S>* const start : {&state, &reversed}) {
    start->p << S(1) / 3, S(-1) / 5, S(1) / 7, S(1) / 9;
    start->p_carry = start->p * S(epsilon<S>() / 4);
  }
  BackwardStepper<S>(run.stepper).step(state, run.grid.step());
  reversed.p = -reversed.p.eval();
  reversed.p_carry = -reversed.p_carry.eval();
  other.step();
  EXPECT_EQ(state.q, reversed.q);
  EXPECT_EQ(state.q_carry, reversed.q_carry);
  EXPECT_EQ(state.p, Vector<S>(-reversed.p));
  EXPECT_EQ(state.p_carry, Vector<S>(-reversed.p_carry));
}

TEST(Backward, LeavesTheStateOfAFailedStepAlone) {
  Scene scene = load_scene("kepler");
  SceneRun<double> run(scene, 2, 2, "1/16", "1");
  run.state.q.setZero();
  const State<double> before = run.state;
  BackwardStepper<double> backward(run.stepper);
  EXPECT_THROW(backward.step(run.state, run.grid.step()), StageFailure);
  EXPECT_EQ(run.state.p, before.p);
}

}  // namespace
}  // namespace hbvm::core
