#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

#include "interrupting.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "step/odeint_methods.hpp"
#include "step/registry.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class BulirschStoerTest : public InDigits<40> {};
TYPED_TEST_SUITE(BulirschStoerTest, AllScalars, ScalarNames);

/// As many digits as are asked for, whatever the step; not many more.
TYPED_TEST(BulirschStoerTest, ReachesItsDigits) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "modified_pendulum", "kepler"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const auto hbvm = parse_method("hbvm:12,12")->make_stepper(scene.problem, SolverKind::automatic);
    State<S> exact(scene.q0, scene.p0);
    for (int n = 0; n < 16; ++n) hbvm->step(exact, S(S(1) / 16));
    const std::vector<int> asked = std::same_as<S, double> ? std::vector{4, 8, 12} : std::vector{8, 16, 24};
    for (const int tolerance : asked)
      for (const long steps : {1L, 16L}) {
        const MethodPtr method = parse_method("bulirsch_stoer:" + std::to_string(tolerance));
        const auto stepper = method->make_stepper(scene.problem, SolverKind::automatic);
        State<S> state(scene.q0, scene.p0);
        for (long n = 0; n < steps; ++n) stepper->step(state, S(S(1) / S(steps)));
        const double found = -std::log10(approximately(distance(state.q, exact.q)));
        EXPECT_GE(found, tolerance - 1.5) << name << ' ' << tolerance << ' ' << steps;
        if (steps == 1) {
          EXPECT_LE(found, tolerance + 6) << name << ' ' << tolerance;
        }
      }
  }
}

TEST(BulirschStoer, IsEndedByASignalBetweenParts) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  const auto stepper = parse_method("bulirsch_stoer:10")->make_stepper(scene.problem, SolverKind::automatic);
  State<double> state(scene.q0, scene.p0);
  interruption = SIGTERM;
  EXPECT_THROW(stepper->step(state, 100), Interrupted);
  EXPECT_EQ(stepper->step(state, 1.0 / 1'024).sweeps, 1);
  interruption = 0;
}

/// Powers of 2 of length and time change nothing but the units.
TEST(BulirschStoer, DoesTheSameInOtherUnits) {
  const auto run = [](const char* length, const char* speed, const char* gravity, double h) {
    const std::string text = std::string(
                                 "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = "
                                 "\"a\", mass = 1, position = [\"") +
                             length + "\", 0], velocity = [0, \"" + speed +
                             "\"] }]\nconstraint = [{ kind = \"rod\", between = [\"a\", \"o\"], length = \"" + length +
                             "\" }]\neffect = [{ kind = \"uniform_gravity\", acceleration = [0, \"-" + gravity +
                             "\"] }]\n";
    const Assembled<double> scene = assemble<double>(read_scene(text, "a pendulum"));
    const auto stepper = parse_method("bulirsch_stoer:10")->make_stepper(scene.problem, SolverKind::automatic);
    State<double> state(scene.q0, scene.p0);
    long tries = 0;
    for (int n = 0; n < 3; ++n) tries += stepper->step(state, h).sweeps;
    return std::pair(Vector<double>(state.q), tries);
  };
  const auto [q, tries] = run("1", "1/2", "1", 1);
  // 1024 times as long, a time unit of 4.
  const auto [long_q, long_tries] = run("1024", "128", "64", 4);
  EXPECT_EQ(long_q, Vector<double>(1024 * q));
  EXPECT_EQ(long_tries, tries);
}

TEST(BulirschStoer, RefusesDigitsThatThereAreNot) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  const MethodPtr method = parse_method("bulirsch_stoer:20");
  expect_words(message_of([&] { method->make_stepper(scene.problem, SolverKind::automatic); }), {"--precision"});
  const PrecisionScope digits(40);
  const Assembled<Mpfr> more = assemble<Mpfr>(load_scene("double_pendulum"));
  EXPECT_TRUE(method->make_stepper(more.problem, SolverKind::automatic));
}

/// Odeint's norms take what is not a number for no error.
TEST(BulirschStoer, FailsInAFallIntoTheCentre) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  const auto stepper = parse_method("bulirsch_stoer:10")->make_stepper(scene.problem, SolverKind::automatic);
  State<double> falling(scene.q0, Vector<double>::Zero(2));
  EXPECT_THROW(stepper->step(falling, 10), StageFailure);
  EXPECT_EQ(falling.q, scene.q0);
}

}  // namespace
}  // namespace hbvm::core
