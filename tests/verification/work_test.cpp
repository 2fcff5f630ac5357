#include <functional>

#include "integrate/output_state.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/taylor.hpp"
#include "step/stepping.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

/// Forces without a potential, moving points and forces that depend on t, in one mechanism each.
const std::vector<std::string>& scenes_with_work() {
  static const std::vector<std::string> names{"charge_on_ellipsoid",    "damped_charge", "driven_pendulum",
                                              "damped_double_pendulum", "motor_linkage", "foucault_pendulum"};
  return names;
}

/// Errors at t = 1/2 against the Taylor series, which shares with HBVM nothing but the scene.
struct Errors {
  Mpfr q = 0, p = 0, lambda = 0, work = 0, balance = 0, g = 0, H = 0;
};

class WithWork : public ::testing::Test {
 protected:
  PrecisionScope digits{40};

  static Errors errors_of(const std::string& method, const Assembled<Mpfr>& scene, const ExactPoint& exact,
                          long steps) {
    const Problem<Mpfr>& problem = scene.problem;
    const Index bodies = problem.mass.of_bodies();
    StateEvaluator<Mpfr> point(problem);
    const auto stepper = parse_method(method)->make_stepper(problem, SolverKind::newton);
    State<Mpfr> state(scene.q0, scene.p0);
    const Mpfr B0 = point.balance(state.q, state.p), H0 = point.energy(state.q, state.p);
    Errors errors;
    for (long n = 0; n < steps; ++n) {
      stepper->step(state, Mpfr(1) / (2 * steps));
      raise_to(errors.balance, magnitude(Mpfr(point.balance(state.q, state.p) - B0)));
      raise_to(errors.H, magnitude(Mpfr(point.energy(state.q, state.p) - H0)));
      raise_to(errors.g, max_norm(point.constraints(state.q)));
    }
    const OutputState<Mpfr> output = output_state(point, state.q, state.p);
    errors.q = distance(Vector<Mpfr>(state.q.head(bodies)), Vector<Mpfr>(exact.q.head(bodies)));
    errors.p = distance(Vector<Mpfr>(output.p.head(bodies)), Vector<Mpfr>(exact.p.head(bodies)));
    errors.lambda = distance(output.lambda, exact.lambda);
    errors.work = magnitude(Mpfr(point.account(output.p) - point.account(exact.p)));
    return errors;
  }

  static ExactPoint exact_at_half(const Assembled<Mpfr>& scene) {
    TaylorMotion motion(scene.problem, scene.q0, scene.p0);
    motion.advance_to(Mpfr(1) / 2);
    return motion.output();
  }
};

/// q, the tangential p, the multiplier and the work of the output state have order 2s.
TEST_F(WithWork, OrdersAreTwiceS) {
  for (const std::string& name : scenes_with_work()) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const ExactPoint exact = exact_at_half(scene);
    for (const int s : {1, 2, 3}) {
      const std::string method = "hbvm:" + std::to_string(s + 1) + "," + std::to_string(s);
      const Errors coarse = errors_of(method, scene, exact, 32), fine = errors_of(method, scene, exact, 64);
      EXPECT_NEAR(order_of(coarse.q, fine.q), 2 * s, 0.4) << name << ", q by " << method;
      EXPECT_NEAR(order_of(coarse.p, fine.p), 2 * s, 0.4) << name << ", p by " << method;
      EXPECT_NEAR(order_of(coarse.lambda, fine.lambda), 2 * s, 0.4) << name << ", lambda by " << method;
      if (!scene.problem.driven.empty()) {
        EXPECT_GE(order_of(coarse.work, fine.work), 2 * s - 0.4) << name << ", W by " << method;
      }
    }
  }
}

/// H - W falls with order 2k where U is no polynomial, and is round-off where it is one. g is round-off on surfaces and
/// links that stand still, and has order 2r where a point moves.
TEST_F(WithWork, BalanceAndConstraints) {
  for (const std::string& name : scenes_with_work()) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const ExactPoint exact = exact_at_half(scene);
    const bool driven = name == "driven_pendulum";
    for (const int s : {1, 2, 3})
      for (const int k : {s, s + 1}) {
        const std::string method = "hbvm:" + std::to_string(k) + "," + std::to_string(s);
        const Errors coarse = errors_of(method, scene, exact, 32), fine = errors_of(method, scene, exact, 64);
        if (driven) {
          EXPECT_NEAR(order_of(coarse.balance, fine.balance), 2 * k, 0.4) << name << ", H - W by " << method;
          EXPECT_NEAR(order_of(coarse.g, fine.g), 2 * k, 0.4) << name << ", g by " << method;
        } else {
          EXPECT_LE(fine.balance, 10'000 * epsilon<Mpfr>()) << name << ", H - W by " << method;
          EXPECT_LE(fine.g, 1'000 * epsilon<Mpfr>()) << name << ", g by " << method;
        }
      }
  }
}

/// A force that does no work does none in any step, whatever the nodes and the step.
TEST_F(WithWork, MagneticAndCoriolisForcesLeaveH) {
  for (const std::string name : {"charge_on_ellipsoid", "foucault_pendulum"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const ExactPoint exact = exact_at_half(scene);
    for (const char* const method : {"hbvm:1,1", "hbvm:3,1", "hbvm:2,2", "hbvm:5,3"})
      EXPECT_LE(errors_of(method, scene, exact, 4).H, 1'000 * epsilon<Mpfr>()) << name << " by " << method;
  }
}

/// As many steps of size -h lead back.
TEST_F(WithWork, StepsBackLeadToTheStart) {
  for (const std::string& name : scenes_with_work()) {
    SceneSteps<Mpfr> run(load_scene(name), "hbvm:4,3", SolverKind::newton);
    const Mpfr h = Mpfr(1) / 16;
    for (int n = 0; n < 8; ++n) run.step(h);
    EXPECT_GT(distance(run.state.q, run.scene.q0), h / 4) << name;
    for (int n = 0; n < 8; ++n) run.step(-h);
    EXPECT_LE(distance(run.state.q, run.scene.q0), 10'000 * epsilon<Mpfr>()) << name;
    EXPECT_LE(distance(run.state.p, run.scene.p0), 100'000 * epsilon<Mpfr>()) << name;
  }
}

/// The fixed-point iteration and Newton's method solve the same equations.
TEST_F(WithWork, SolversAgree) {
  for (const std::string& name : scenes_with_work()) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const Mpfr h = Mpfr(1) / 32;
    const State<Mpfr> by_newton = after("hbvm:3,2", scene, h, 8, SolverKind::newton),
                      by_sweeps = after("hbvm:3,2", scene, h, 8, SolverKind::fixed_point);
    EXPECT_LE(distance(by_newton.q, by_sweeps.q), 10'000 * epsilon<Mpfr>()) << name;
    EXPECT_LE(distance(by_newton.p, by_sweeps.p), 10'000 * epsilon<Mpfr>()) << name;
  }
}

/// Explicit and implicit Runge-Kutta methods find the same motions, by other equations.
TEST_F(WithWork, RungeKuttaMethodsHaveTheirOrder) {
  for (const std::string& name : scenes_with_work()) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const ExactPoint exact = exact_at_half(scene);
    for (const auto& [method, order] : std::vector<std::pair<std::string, int>>{{"rk4", 4}, {"radau:2", 3}}) {
      const Errors coarse = errors_of(method, scene, exact, 64), fine = errors_of(method, scene, exact, 128);
      EXPECT_NEAR(order_of(coarse.q, fine.q), order, 0.4) << name << " by " << method;
      EXPECT_NEAR(order_of(coarse.balance, fine.balance), order, 1.3) << name << " by " << method;
    }
  }
}

/// H - W is constant along the exact motion.
TEST_F(WithWork, TaylorSeriesKeepTheBalance) {
  for (const std::string& name : scenes_with_work()) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    StateEvaluator<Mpfr> point(scene.problem);
    TaylorMotion motion(scene.problem, scene.q0, scene.p0);
    motion.advance_to(Mpfr(2));
    EXPECT_LE(magnitude(Mpfr(point.balance(motion.q(), motion.p()) - point.balance(scene.q0, scene.p0))),
              10'000 * epsilon<Mpfr>())
        << name;
    EXPECT_LE(max_norm(point.constraints(motion.q())), 1'000 * epsilon<Mpfr>()) << name;
    EXPECT_LE(max_norm(point.hidden_constraints(motion.q(), motion.p())), 1'000 * epsilon<Mpfr>()) << name;
  }
}

}  // namespace
}  // namespace hbvm::core
