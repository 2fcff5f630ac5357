#include "step/runge_kutta_stepper.hpp"

#include "method/tableaux.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "step/compensated_sum.hpp"
#include "step/hbvm_stepper.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
RungeKutta<S> classical() {
  return make_runge_kutta<S>(rk4());
}

template <Scalar S>
RungeKutta<S> radau() {
  return make_runge_kutta<S>(radau_iia());
}

template <Scalar S>
S distance(const State<S>& a, const State<S>& b) {
  S r = max_norm(Vector<S>(a.q - b.q));
  raise_to(r, max_norm(Vector<S>(a.p - b.p)));
  return r;
}

template <class S>
class RungeKuttaSteps : public InDigits<50> {
 protected:
  const Assembled<S> kepler = assemble<S>(load_scene("kepler"));

  State<S> run(const RungeKutta<S>& method, const S& h, long steps) const {
    RungeKuttaStepper<S> step(kepler.problem, method);
    return after<S>(step, kepler, h, steps);
  }
};
TYPED_TEST_SUITE(RungeKuttaSteps, AllScalars, ScalarNames);

TYPED_TEST(RungeKuttaSteps, GaussIsHbvmOfEqualStages) {
  using S = TypeParam;
  for (int s = 1; s <= 4; ++s)
    for (const S& h : {S(S(1) / 20), S(S(-1) / 20)}) {
      const State<S> expected = after(HbvmName{s, s}.text(), this->kepler, h, 20, SolverKind::fixed_point);
      EXPECT_LE(distance(this->run(gauss<S>(s), h, 20), expected), 100 * epsilon<S>()) << s;
    }
}

/// The four stages written out.
TYPED_TEST(RungeKuttaSteps, ClassicalMethodStageByStage) {
  using S = TypeParam;
  const auto force = [](const Vector<S>& q) {
    using std::sqrt;
    const S r = sqrt(S(q[0] * q[0] + q[1] * q[1]));
    return Vector<S>(-q / (r * r * r));
  };
  const S h = S(1) / 16, half = h / 2;
  const Vector<S>&q = this->kepler.q0, &p = this->kepler.p0;
  const Vector<S> F1 = force(q), V2 = p + half * F1, F2 = force(Vector<S>(q + half * p)), V3 = p + half * F2,
                  F3 = force(Vector<S>(q + half * V2)), V4 = p + h * F3, F4 = force(Vector<S>(q + h * V3));
  State<S> expected(q, p);
  expected.q += h / 6 * (p + 2 * V2 + 2 * V3 + V4);
  expected.p += h / 6 * (F1 + 2 * F2 + 2 * F3 + F4);
  EXPECT_LE(distance(this->run(classical<S>(), h, 1), expected), 16 * epsilon<S>());

  RungeKuttaStepper<S> step(this->kepler.problem, classical<S>());
  State<S> state(q, p);
  EXPECT_TRUE(step.is_explicit());
  EXPECT_EQ(step.step(state, h).sweeps, 1);
  ASSERT_EQ(step.counts().parts.size(), 2u);
  EXPECT_EQ(step.counts().parts[1].calls, 1u);
}

/// The error of one step falls by 2^(p + 1) as the step is halved. (Not from the pericentre, where by symmetry some of
/// the terms vanish.)
TYPED_TEST(RungeKuttaSteps, LocalErrorHasTheOrderOfTheMethod) {
  using S = TypeParam;
  const Hbvm<S> fine = make_hbvm<S>(8, 8);
  const State<S> start = after("hbvm:8,8", this->kepler, S(1) / 4, 4, SolverKind::fixed_point);
  for (const auto& [method, p] :
       {std::pair{classical<S>(), 4}, {radau<S>(), 3}, {gauss<S>(1), 2}, {gauss<S>(2), 4}, {gauss<S>(3), 6}}) {
    S last = 0;
    for (const int divisor : {8, 16, 32, 64}) {
      const S h = S(1) / divisor;
      HbvmStepper<S> reference(this->kepler.problem, fine, SolverKind::fixed_point);
      RungeKuttaStepper<S> step(this->kepler.problem, method);
      State<S> expected = start, state = start;
      reference.step(expected, h);
      step.step(state, h);
      const S error = distance(state, expected);
      if (last != 0 && error > 1'000 * epsilon<S>()) {
        EXPECT_NEAR(order_of(last, error), p + 1, 0.3) << p << " " << divisor;
      }
      last = error;
    }
  }
}

/// RK4 and Gauss come to the same end where both are converged.
TYPED_TEST(RungeKuttaSteps, ClassicalMethodConvergesToTheOrbit) {
  using S = TypeParam;
  const State<S> expected = after("hbvm:8,8", this->kepler, S(1) / 32, 32, SolverKind::fixed_point);
  S last = 0;
  for (const long steps : {128L, 256L, 512L}) {
    const S error = distance(this->run(classical<S>(), S(S(1) / S(steps)), steps), expected);
    if (last != 0) {
      EXPECT_NEAR(order_of(last, error), 4, 0.2);
    }
    last = error;
  }
  EXPECT_LE(last, literal<S>("1e-7"));
}

TYPED_TEST(RungeKuttaSteps, GaussKeepsTheAngularMomentum) {
  using S = TypeParam;
  const auto momentum = [](const State<S>& x) { return S(x.q[0] * x.p[1] - x.q[1] * x.p[0]); };
  const S start = momentum(State<S>(this->kepler.q0, this->kepler.p0)), h = S(1) / 10;
  EXPECT_LE(magnitude(S(momentum(this->run(gauss<S>(2), h, 50)) - start)), 50 * epsilon<S>());
  EXPECT_GT(magnitude(S(momentum(this->run(radau<S>(), h, 50)) - start)), literal<S>("1e-6"));
}

TYPED_TEST(RungeKuttaSteps, TakesFullMassMatricesAndConstantForces) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(read_scene(R"(dimension = 2
[[body]]
name = "a"
mass = [[2, "1/4"], ["1/4", 1]]
position = [1, -3]
velocity = [0.1, 2]
[[effect]]
kind = "uniform_gravity"
acceleration = ["1/3", "-1/7"]
)",
                                                    "scene"));
  const S h = S(1) / 4;
  // A parabola, which all of them follow.
  const State<S> expected = after("hbvm:2,2", scene, h, 8, SolverKind::fixed_point);
  for (const RungeKutta<S>& other : {classical<S>(), radau<S>(), gauss<S>(1)}) {
    RungeKuttaStepper<S> step(scene.problem, other);
    EXPECT_LE(distance(after<S>(step, scene, h, 8), expected), 50 * epsilon<S>());
  }
}

using RungeKuttaSum = CompensatedSum;

/// By both kinds of methods: the stages of the one are computed in turn, those of the other found by iteration. The
/// weights 1/6 and 1/3 do not add up to 1 exactly, so that an increment is off by half of its own last place.
constexpr double half_an_ulp = 0.5;

TEST_F(RungeKuttaSum, OfMomentaLosesNothingOverManySmallSteps) {
  const Assembled<double> scene = assemble<double>(read_scene(falling, "falling"));
  for (const RungeKutta<double>& method : {classical<double>(), gauss<double>(1)}) {
    RungeKuttaStepper<double> step(scene.problem, method);
    const State<double> end = after<double>(step, scene, h, steps);
    expect_exact_sum(scene.p0[0], h * literal<double>("1/3"), end.p[0], end.p_carry[0], half_an_ulp);
    expect_exact_sum(scene.p0[1], h * literal<double>("-1/7"), end.p[1], end.p_carry[1], half_an_ulp);
  }
}

TEST_F(RungeKuttaSum, OfPositionsLosesNothingOverManySmallSteps) {
  const Assembled<double> scene = assemble<double>(read_scene(floating, "floating"));
  for (const RungeKutta<double>& method : {classical<double>(), gauss<double>(2)}) {
    RungeKuttaStepper<double> step(scene.problem, method);
    const State<double> end = after<double>(step, scene, h, steps);
    for (Index j = 0; j < 2; ++j) expect_exact_sum(scene.q0[j], h * scene.p0[j], end.q[j], end.q_carry[j], half_an_ulp);
  }
}

/// The index-reduced equations have the same solutions. RK4 converges to them with order 4, plain or projected. What it
/// makes of the constraints falls likewise, or is round-off in every step.
TYPED_TEST(RungeKuttaSteps, TakeConstraintsByTheIndexReducedEquations) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const State<S> expected = after("hbvm:8,8", scene, S(1) / 64, 16);
  StateEvaluator<S> point(scene.problem);
  const Vector<S> p = point.tangential(expected.q, expected.p);
  for (const OnConstraints on_constraints : {OnConstraints::drift, OnConstraints::project}) {
    S last_error = 0, last_g = 0;
    for (const long steps : {8L, 16L, 32L}) {
      RungeKuttaStepper<S> stepper(scene.problem, classical<S>(), on_constraints);
      StepResult<S> step;
      const State<S> end = after<S>(stepper, scene, S(1) / S(4 * steps), steps, &step);
      const S error = std::max(hbvm::core::distance(end.q, expected.q), hbvm::core::distance(end.p, p)),
              g = max_norm(point.constraints(end.q)), hidden = max_norm(point.hidden_constraints(end.q, end.p));
      if (last_error != 0) {
        EXPECT_NEAR(order_of(last_error, error), 4, 0.3) << steps;
      }
      if (on_constraints == OnConstraints::project) {
        EXPECT_LE(g, 16 * epsilon<S>());
        EXPECT_LE(hidden, 64 * epsilon<S>());
      } else {
        EXPECT_GT(g, 1'000 * epsilon<S>());
        if (last_g != 0) {
          EXPECT_GT(last_g, 8 * g);
        }
      }
      EXPECT_LE(hbvm::core::distance(*step.multiplier, point.multiplier(end.q, end.p)), 4'096 * epsilon<S>());
      last_error = error;
      last_g = g;
    }
  }
}

/// Two rods in line hold a body from both sides: where their gradients are parallel no multiplier is to be found.
TYPED_TEST(RungeKuttaSteps, WithDependentConstraintsFailAndLeaveTheState) {
  using S = TypeParam;
  Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  scene.problem.constraints[1] = scene.problem.constraints[0];
  RungeKuttaStepper<S> stepper(scene.problem, classical<S>(), OnConstraints::project);
  State<S> state(scene.q0, scene.p0);
  EXPECT_THROW(stepper.step(state, S(S(1) / 16)), StageFailure);
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
}

TYPED_TEST(RungeKuttaSteps, RefusesShapes) {
  using S = TypeParam;
  RungeKutta<S> method = classical<S>();
  method.b = Vector<S>::Zero(3);
  EXPECT_THROW(RungeKuttaStepper<S>(this->kepler.problem, method), InputError);
  method = {Matrix<S>(0, 0), Vector<S>(0), Vector<S>(0)};
  EXPECT_THROW(RungeKuttaStepper<S>(this->kepler.problem, method), InputError);
}

TYPED_TEST(RungeKuttaSteps, SaysSoWhereItFails) {
  using S = TypeParam;
  State<S> state(this->kepler.q0, this->kepler.p0);
  RungeKuttaStepper<S> far(this->kepler.problem, gauss<S>(3));
  EXPECT_THROW(far.step(state, S(2)), StageFailure);
  EXPECT_EQ(state.q, this->kepler.q0);
  EXPECT_EQ(state.p, this->kepler.p0);
  // In the centre of the force it is not finite.
  for (const RungeKutta<S>& method : {classical<S>(), gauss<S>(2)}) {
    State<S> centre(Vector<S>::Zero(2), Vector<S>::Zero(2));
    RungeKuttaStepper<S> step(this->kepler.problem, method);
    EXPECT_THROW(step.step(centre, S(S(1) / 10)), StageFailure);
    EXPECT_EQ(max_norm(centre.q), 0);
  }
}

}  // namespace
}  // namespace hbvm::core
