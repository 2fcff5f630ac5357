#include "integrate/between_steps.hpp"

#include <array>
#include <cmath>

#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "reference/taylor.hpp"
#include "scalar/log2_of.hpp"
#include "solver/stage_failure.hpp"
#include "step/hbvm_method.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
BetweenSteps<S> between_of(const Problem<S>& problem, int k, int s) {
  return BetweenSteps<S>(hbvm_of({k, s})->make_stepper<S>(problem, SolverKind::automatic));
}

class BetweenStepsTest : public InDigits<50> {};

/// log2 of the errors of q, p and lambda at five places of a step, from the mesh point before and that after.
std::array<double, 3> errors(const Scene& scene, int s, const char* step, bool from_after) {
  SceneRun<Mpfr> run(scene, 2 * s, s, step, "2", SolverKind::newton);
  Recorder<Mpfr> recorder;
  run({&recorder});
  BetweenSteps<Mpfr> between = between_of(run.scene.problem, 2 * s, s);
  TaylorMotion exact(run.scene.problem, run.scene.q0, run.scene.p0);
  std::array<Mpfr, 3> worst{};
  const std::size_t n = recorder.seen.size() / 2;
  for (const int tenth : {1, 3, 5, 7, 9}) {
    const Mpfr t = recorder.seen[n].t + run.grid.step() * tenth / 10;
    const StateBetween<Mpfr> state = between.at(recorder.seen[from_after ? n + 1 : n], t);
    exact.advance_to(t);
    raise_to(worst[0], max_norm(Vector<Mpfr>(state.q - exact.q())));
    raise_to(worst[1], max_norm(Vector<Mpfr>(state.p - exact.p())));
    raise_to(worst[2], max_norm(Vector<Mpfr>(state.lambda - exact.lambda())));
  }
  return {log2_of(worst[0]), log2_of(worst[1]), log2_of(worst[2])};
}

/// q, p and lambda of order 2s within a step. The polynomial of the step has order s + 1 only.
TEST_F(BetweenStepsTest, HaveOrderTwoS) {
  for (const int s : {1, 2, 3, 4, 5, 6})
    for (const bool from_after : {false, true}) {
      const auto coarse = errors(load_scene("double_pendulum"), s, "1/32", from_after),
                 fine = errors(load_scene("double_pendulum"), s, "1/64", from_after);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(coarse[i] - fine[i], 2 * s, 0.4) << s << " " << i;
    }
}

TYPED_TEST_SUITE_P(BetweenStepsOf);
template <class S>
class BetweenStepsOf : public InDigits<40> {};
TYPED_TEST_P(BetweenStepsOf, AreExactAtMeshPointsAndKeepTheConstraints) {
  using S = TypeParam;
  SceneRun<S> run(load_scene("double_pendulum"), 4, 2, "1/16", "1", SolverKind::newton);
  Recorder<S> recorder;
  run({&recorder});
  BetweenSteps<S> between = between_of(run.scene.problem, 4, 2);
  StateEvaluator<S> point(run.scene.problem);
  const Snapshot<S>& mesh = recorder.seen[5];
  const OutputState<S> output = output_state(point, mesh.q, mesh.p);
  const StateBetween<S> there = between.at(mesh, mesh.t);
  EXPECT_EQ(there.q, mesh.q);
  EXPECT_EQ(there.p, output.p);
  EXPECT_EQ(there.lambda, output.lambda);
  const StateBetween<S> later = between.at(mesh, S(mesh.t + run.grid.step() / 3));
  for (const Constraint<S>& constraint : run.scene.problem.constraints)
    EXPECT_TRUE(value(constraint, run.scene.problem.dimension, later.q).vanishes());
  EXPECT_LE(max_norm(Vector<S>(later.p - point.tangential(later.q, later.p))), 64 * epsilon<S>() * max_norm(later.p));
}
REGISTER_TYPED_TEST_SUITE_P(BetweenStepsOf, AreExactAtMeshPointsAndKeepTheConstraints);
INSTANTIATE_TYPED_TEST_SUITE_P(Scalars, BetweenStepsOf, AllScalars);

/// A stepper that can make no step.
class NoStepper final : public ForwardingStepper<double> {
 public:
  using ForwardingStepper<double>::ForwardingStepper;
  StepResult<double> step(State<double>&, const double&) override {
    throw StageFailure(FailureCause::stage_equations_diverge, "no step", "1", 1);
  }
};

TEST_F(BetweenStepsTest, SayWhichStepFails) {
  SceneRun<double> run(load_scene("double_pendulum"), 4, 2, "1/16", "1");
  Recorder<double> recorder;
  run({&recorder});
  BetweenSteps<double> between(
      std::make_unique<NoStepper>(hbvm_of({4, 2})->make_stepper<double>(run.scene.problem, SolverKind::automatic)));
  const Snapshot<double>& mesh = recorder.seen[2];
  EXPECT_EQ(between.at(mesh, mesh.t).q, mesh.q);
  for (const double t : {0.15, 0.1})
    expect_words(message_of<IntegrationError>([&] { between.at(mesh, t); }),
                 {"from the mesh point t = 0.125", "to t = " + std::to_string(t).substr(0, 3), "no step"});
}

}  // namespace
}  // namespace hbvm::core
