#include "reference/taylor_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "interrupting.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "step/registry.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

class TaylorMethod : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    add_taylor_method();
    add_taylor_method();  // once more is no more
  }
};

/// All digits are right whatever the step, with energy and both kinds of constraints.
TEST_F(TaylorMethod, HasAllDigitsWhateverTheStep) {
  for (const unsigned digits : {30U, 60U}) {
    const PrecisionScope scope(digits);
    for (const char* const name : {"double_pendulum", "tethered_satellites", "kepler"}) {
      const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
      StateEvaluator<Mpfr> point(scene.problem);
      const auto end = [&](const char* method, long steps) {
        const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::automatic);
        State<Mpfr> state(scene.q0, scene.p0);
        for (long n = 0; n < steps; ++n) {
          EXPECT_EQ(stepper->step(state, Mpfr(Mpfr(1) / steps)).multiplier->size(), scene.problem.nu());
        }
        return state;
      };
      const State<Mpfr> exact = end("hbvm:24,24", 16), once = end("taylor", 1), often = end("taylor", 5);
      const Mpfr tolerance = 10'000 * epsilon<Mpfr>() * max_norm(exact.q);
      EXPECT_LE(distance(once.q, exact.q), tolerance) << name << digits;
      EXPECT_LE(distance(often.q, exact.q), tolerance) << name << digits;
      EXPECT_LE(abs(Mpfr(point.energy(once.q, once.p) - point.energy(scene.q0, scene.p0))),
                1'000 * epsilon<Mpfr>() * point.energy_size(once.q, once.p))
          << name << digits;
      if (scene.problem.nu() == 0) continue;
      EXPECT_LE(max_norm(point.constraints(once.q)), 64 * epsilon<Mpfr>() * point.constraint_size(once.q)) << name;
      EXPECT_LE(max_norm(point.hidden_constraints(once.q, once.p)), 1'000 * epsilon<Mpfr>()) << name;
    }
  }
}

TEST_F(TaylorMethod, KnowsTheMultiplierOfTheEnd) {
  const PrecisionScope scope(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  const auto stepper = parse_method("taylor")->make_stepper(scene.problem, SolverKind::automatic);
  State<Mpfr> state(scene.q0, scene.p0);
  const StepResult<Mpfr> step = stepper->step(state, Mpfr(2));
  EXPECT_GT(step.sweeps, 1);
  StateEvaluator<Mpfr> point(scene.problem);
  EXPECT_LE(distance(*step.multiplier, point.multiplier(state.q, state.p)), 1'000 * epsilon<Mpfr>());
}

TEST_F(TaylorMethod, GoesOnFromWhatItRemembers) {
  const PrecisionScope scope(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("tethered_satellites"));
  const auto make = parse_method("taylor")->prepare(scene.problem, SolverKind::automatic);
  const auto whole = make(), part = make();
  State<Mpfr> state(scene.q0, scene.p0);
  for (int n = 0; n < 2; ++n) whole->step(state, Mpfr(Mpfr(1) / 2));
  Archive writing;
  writing(*whole, state);
  Archive reading(writing.text());
  State<Mpfr> resumed = state;
  reading(*part, resumed);
  reading.expect_end();
  const StepResult<Mpfr> again = part->step(resumed, Mpfr(Mpfr(1) / 2)), once = whole->step(state, Mpfr(Mpfr(1) / 2));
  EXPECT_EQ(again.sweeps, once.sweeps);
  EXPECT_EQ(resumed.q, state.q);
  EXPECT_EQ(resumed.p, state.p);
  EXPECT_EQ(*again.multiplier, *once.multiplier);
  EXPECT_EQ(part->counts().effects[0].evaluations, whole->counts().effects[0].evaluations);
  EXPECT_GT(whole->counts().effects[0].evaluations, 0U);
}

TEST_F(TaylorMethod, IsForMpfrAlone) {
  const auto& all = method_families();
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const MethodFamily& f) { return f.name == "taylor"; }), 1);
  EXPECT_THROW(parse_method("taylor:20"), InputError);
  const MethodPtr method = parse_method("taylor");
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  const Assembled<Quad> quad = assemble<Quad>(load_scene("double_pendulum"));
  expect_words(message_of([&] { method->make_stepper(scene.problem, SolverKind::automatic); }), {"mpfr:"});
  EXPECT_THROW(method->make_stepper(quad.problem, SolverKind::automatic), InputError);
}

TEST_F(TaylorMethod, IsEndedByASignalWithinAStep) {
  const PrecisionScope scope(30);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("kepler"));
  const auto stepper = parse_method("taylor")->make_stepper(scene.problem, SolverKind::automatic);
  State<Mpfr> state(scene.q0, scene.p0);
  interruption = SIGTERM;
  EXPECT_THROW(stepper->step(state, Mpfr(10)), Interrupted);
  interruption = 0;
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_GT(stepper->step(state, Mpfr(10)).sweeps, 1);
}

TEST_F(TaylorMethod, LeavesTheStateAtASingularity) {
  const PrecisionScope scope(30);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("kepler"));
  const auto stepper = parse_method("taylor")->make_stepper(scene.problem, SolverKind::automatic);
  State<Mpfr> falling(scene.q0, Vector<Mpfr>::Zero(2));
  EXPECT_THROW(stepper->step(falling, Mpfr(10)), StageFailure);
  EXPECT_EQ(falling.q, scene.q0);
}

}  // namespace
}  // namespace hbvm::core
