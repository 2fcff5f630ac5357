#include "reference/proof/ball_problem.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/proof/holds.hpp"

namespace hbvm::core {
namespace {

/// Masses, forces, gradients of constraints and the energy hold what the scene's own evaluation finds. Bounds have
/// nearly all digits, for rods, quadrics, formulas, rigid bodies and joints.
TEST(BallProblem, HoldsWhatTheSceneHas) {
  const PrecisionScope digits(40);
  for (const char* name :
       {"double_pendulum", "tethered_satellites", "heavy_top", "bead_on_torus", "bead_on_helix",
        "charged_double_pendulum", "four_bar_linkage_of_bars", "gyroscope_on_gimbal", "fekete_points"}) {
    const ProvedScene scene(load_scene(name));
    const BallProblem balls = scene.balls();
    const BallScope bits(240);
    const Problem<Mpfr>& problem = scene.exact.problem;
    // Somewhere off the constraints, where nothing vanishes by chance.
    const PrecisionScope twice(100);
    Vector<Mpfr> q = scene.exact.q0;
    for (Index j = 0; j < q.size(); ++j) q[j] += Mpfr(j + 1) / 100;
    std::vector<RealBall> at, force;
    for (const Mpfr& x : q) at.push_back(believed(x));
    StateEvaluator<Mpfr> point(problem);
    const Vector<Mpfr> none = Vector<Mpfr>::Zero(problem.m()), F = point.forces(q, none).applied;
    for (const BallSeries& x : balls.force(as_series(at), 1)) force.push_back(x[0]);
    expect_held(force, F, std::string(name) + ": the force");
    EXPECT_TRUE(holds(balls.potential_energy(at), point.energy(q, none))) << name;
    expect_held(balls.constraint_values(at), point.constraints(q), std::string(name) + ": g");
    for (const RealBall& g : balls.constraint_values(at)) EXPECT_LT(radius_of(g), 1e-40) << name;
    EXPECT_TRUE(holds(balls.potential_energy(at) - balls.potential_energy(at), Mpfr(0)));
    // M^-1 M v = v.
    std::vector<RealBall> v;
    for (Index j = 0; j < q.size(); ++j) v.push_back(RealBall(static_cast<int>(j) - 2));
    const std::vector<RealBall> back = balls.velocity(balls.momentum(v));
    for (Index j = 0; j < q.size(); ++j) {
      EXPECT_TRUE(holds(back[static_cast<std::size_t>(j)], Mpfr(j - 2))) << name;
      EXPECT_LT(radius_of(back[static_cast<std::size_t>(j)]), 1e-40) << name;
    }
    // grad g by differences of g, whose error is the square of the step.
    const Mpfr h = Mpfr(1) / Mpfr("1e25");
    RealBall error;
    arb_set_str(raw(error), "1e-22", 64);
    for (Index a = 0; a < problem.nu(); ++a)
      for (const BallSlope& slope : balls.slopes(a, as_series(at), 1)) {
        Vector<Mpfr> moved = q;
        moved[slope.coordinate] += h;
        const Mpfr there = point.constraints(moved)[a], here = point.constraints(q)[a], difference = (there - here) / h;
        EXPECT_TRUE(holds(widened(slope.series[0], error), difference)) << name << " " << a << " " << slope.coordinate;
        EXPECT_LT(radius_of(slope.series[0]), 1e-40) << name;
      }
  }
}

}  // namespace
}  // namespace hbvm::core
