#include "step/hbvm_stepper.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "printing.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"
#include "step/compensated_sum.hpp"
#include "step/stepping.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

TEST(Step, ReturnsTheSweepsOfItsSolver) {
  const Assembled<double> scene = assemble<double>(load_scene(scene_path("ellipsoid_bead")));
  const Hbvm<double> method = make_hbvm<double>(3, 2);
  HbvmStepper<double> stepper(scene.problem, method, SolverKind::paper);
  State<double> state(scene.q0, scene.p0);
  const auto solver = make_solver(SolverKind::paper, scene.problem, method);
  EXPECT_EQ(stepper.step(state, 0.1).sweeps, solver->solve({scene.q0, scene.p0, 0.1}));
}

using CompensatedUpdate = CompensatedSum;

/// Rounding of p1 - p0 - h (grad U - grad g lambda) and q1 - q0 - h (p0 + p1)/2, walks at random. It is summed over
/// many steps of a pendulum under a gravity of 1/10. The same bits of the gravity lost in every step would be a force
/// of its own, and energy and constraint drift.
TEST_F(CompensatedUpdate, LosesNothingOfAConstantForceBesideAConstraint) {
  for (const SolverKind solver : {SolverKind::fixed_point, SolverKind::newton}) {
    SceneSteps<double> pendulum(
        read_scene("dimension = 2\n[[point]]\nname = \"pivot\"\nposition = [0, 0]\n"
                   "[[body]]\nname = \"bob\"\nmass = 1\nposition = [0, -1]\nvelocity = [2, 0]\n"
                   "[[constraint]]\nkind = \"rod\"\nbetween = [\"pivot\", \"bob\"]\nlength = 1\n"
                   "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -0.1]\n",
                   "pendulum"),
        "hbvm:1,1", solver);
    const State<double>& state = pendulum.state;
    constexpr double step = 0.25;
    constexpr int n = 20'000;
    const auto q = [&](Index j) { return Quad(state.q[j]) + Quad(state.q_carry[j]); };
    const auto p = [&](Index j) { return Quad(state.p[j]) + Quad(state.p_carry[j]); };
    Quad p_sum[2] = {0, 0}, q_sum[2] = {0, 0}, p_size = 0, q_size = 0;
    for (int i = 0; i < n; ++i) {
      const Quad q0[2] = {q(0), q(1)}, p0[2] = {p(0), p(1)};
      const Quad lambda = (*pendulum.step(step).multiplier)[0], gravity[2] = {0, Quad(-0.1)};
      for (int j = 0; j < 2; ++j) {
        const Quad tension = (q0[j] + q(j)) * lambda;  // grad g = 2 q at the middle of the step
        p_sum[j] += p(j) - p0[j] - Quad(step) * (gravity[j] - tension);
        q_sum[j] += q(j) - q0[j] - Quad(step / 2) * (p0[j] + p(j));
        p_size += magnitude(tension) / (2 * n);
        q_size += magnitude(p(j)) / (2 * n);
      }
    }
    const Quad walk = Quad(4 * step * epsilon<double>() * std::sqrt(double(n)));
    for (int j = 0; j < 2; ++j) {
      EXPECT_LE(magnitude(p_sum[j]), walk * p_size);
      EXPECT_LE(magnitude(q_sum[j]), walk * q_size);
    }
  }
}

TEST_F(CompensatedUpdate, OfMomentaLosesNothingOverManySmallSteps) {
  const Assembled<double> scene = assemble<double>(read_scene(falling, "falling"));
  const State<double> state = after("hbvm:1,1", scene, h, steps, SolverKind::fixed_point);
  expect_exact_sum(scene.p0[0], h * literal<double>("1/3"), state.p[0], state.p_carry[0]);
  expect_exact_sum(scene.p0[1], h * literal<double>("-1/7"), state.p[1], state.p_carry[1]);
}

TEST_F(CompensatedUpdate, OfPositionsLosesNothingOverManySmallSteps) {
  const Assembled<double> scene = assemble<double>(read_scene(floating, "floating"));
  const State<double> state = after("hbvm:2,2", scene, h, steps, SolverKind::fixed_point);
  for (Index j = 0; j < 2; ++j) expect_exact_sum(scene.q0[j], h * scene.p0[j], state.q[j], state.q_carry[j]);
}

}  // namespace
}  // namespace hbvm::core
