#include "step/rattle.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <class S>
class RattleTest : public InDigits<40> {};
TYPED_TEST_SUITE(RattleTest, AllScalars, ScalarNames);

/// To round-off, whatever the step: Newton's iteration is quadratic, so that only some steps show where it stops.
TYPED_TEST(RattleTest, KeepsTheRodToRoundOffAtEveryStep) {
  using S = TypeParam;
  for (int divisor = 2; divisor < 12; ++divisor) {
    SceneSteps<S> pendulum(load_scene("simple_pendulum"), "rattle");
    const Vector<S>& q = pendulum.state.q;
    for (int n = 0; n < 50; ++n) {
      pendulum.step(S(1) / divisor);
      ASSERT_LE(magnitude(S(q[0] * q[0] + q[1] * q[1] - 1)), 8 * epsilon<S>()) << "h = 1/" << divisor << ", step " << n;
    }
  }
}

/// Order 2 in q and p, and order 1 with one whole kick, against HBVM(6,6).
TYPED_TEST(RattleTest, IsOfOrderTwoAndEulersOfOrderOne) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const State<S> exact = after("hbvm:6,6", scene, S(1) / 32, 32, SolverKind::fixed_point);
  StateEvaluator<S> point(scene.problem);
  const Vector<S> p = point.tangential(exact.q, exact.p);
  for (const auto& [method, order, apart] : {std::tuple("rattle", 2, 0.08), {"symplectic_euler", 1, 0.08}}) {
    S last = 0;
    for (const long steps : {64L, 128L, 256L}) {
      const State<S> state = after(method, scene, S(1) / S(steps), steps);
      const S error = std::max(distance(state.q, exact.q), distance(state.p, p));
      if (last != 0) {
        EXPECT_NEAR(order_of(last, error), order, apart) << method;
      }
      last = error;
    }
  }
}

/// Without constraints: Stormer-Verlet, and the symplectic Euler method.
TYPED_TEST(RattleTest, WithoutConstraintsKicksAndDrifts) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("kepler"));
  const S h = S(1) / 64;
  const auto force = [](const Vector<S>& q) {
    using std::sqrt;
    const S r = sqrt(S(q[0] * q[0] + q[1] * q[1]));
    return Vector<S>(-q / (r * r * r));
  };
  const auto expect = [&](const char* method, const Vector<S>& q, const Vector<S>& p) {
    const State<S> state = after(method, scene, h, 1);
    EXPECT_LE(distance(state.q, q), 16 * epsilon<S>()) << method;
    EXPECT_LE(distance(state.p, p), 16 * epsilon<S>()) << method;
  };
  const Vector<S> whole = scene.p0 + h * force(scene.q0), half = scene.p0 + h / 2 * force(scene.q0),
                  q = scene.q0 + h * half;
  expect("rattle", q, half + h / 2 * force(q));
  expect("symplectic_euler", scene.q0 + h * whole, whole);
}

/// What a step leaves is the multiplier of its end to first order.
TYPED_TEST(RattleTest, MultiplierIsThatOfTheEnd) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  StateEvaluator<S> point(scene.problem);
  for (const char* const method : {"rattle", "symplectic_euler"}) {
    S last = 0;
    for (const long steps : {64L, 128L, 256L}) {
      const auto& [state, multiplier] = end_of(method, scene, S(1) / S(steps), steps);
      const S error = max_norm(Vector<S>(multiplier - point.multiplier(state.q, state.p)));
      if (last != 0) {
        EXPECT_NEAR(order_of(last, error), 1, 0.08) << method;
      }
      last = error;
    }
  }
}

/// What serves the next step is that of the state it starts from, whoever put it there.
TYPED_TEST(RattleTest, TakesAStateThatItDidNotMake) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("kepler"));
  const S h = S(1) / 64;
  Rattle<S> used(scene.problem);
  State<S> elsewhere(Vector<S>(scene.q0 + scene.p0), scene.p0), state(scene.q0, scene.p0);
  used.step(elsewhere, h);
  used.step(state, h);
  const State<S> expected = after("rattle", scene, h, 1);
  EXPECT_EQ(state.q, expected.q);
  EXPECT_EQ(state.p, expected.p);
}

TEST(Rattle, CountsWhatItDid) {
  SceneSteps<double> pendulum(load_scene("double_pendulum"), "rattle");
  long iterations = 0;
  for (int n = 0; n < 10; ++n) iterations += pendulum.step(0.01).sweeps;
  const SolverCounts counts = pendulum.stepper->counts();
  EXPECT_EQ(calls_of(counts, "half kicks and drift"), 10);
  EXPECT_EQ(calls_of(counts, "positions"), iterations + 10);
  EXPECT_EQ(calls_of(counts, "constraint gradients"), iterations + 10 + 1);
  EXPECT_EQ(calls_of(counts, "matrix of multipliers"), iterations + 10);
  EXPECT_EQ(calls_of(counts, "tangential momenta"), 10);
}

/// Two bodies that fly side by side do not pull on their rod: the multiplier is round-off itself.
TYPED_TEST(RattleTest, FindsPositionsWhereNothingPulls) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(
      read_scene("dimension = 2\n"
                 "body = [{ name = \"a\", mass = \"1/3\", position = [\"1/7\", 0], velocity = [\"1/10\", \"3/7\"] },\n"
                 "        { name = \"b\", mass = 3, position = [\"8/7\", 0], velocity = [\"1/10\", \"3/7\"] }]\n"
                 "constraint = [{ kind = \"rod\", between = [\"a\", \"b\"], length = 1 }]\n",
                 "side by side"));
  const State<S> end = after("rattle", scene, S(1) / 10, 100);
  StateEvaluator<S> point(scene.problem);
  EXPECT_LE(max_norm(point.constraints(end.q)), 1'000 * epsilon<S>());
  EXPECT_LE(magnitude(S(end.q[0] - S(8) / 7)), 1'000 * epsilon<S>());
}

}  // namespace
}  // namespace hbvm::core
