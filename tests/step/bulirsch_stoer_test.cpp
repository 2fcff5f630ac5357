#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

#include "interrupting.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "step/odeint_methods.hpp"
#include "step/stepping.hpp"
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
    const State<S> exact = after("hbvm:12,12", scene, S(1) / 16, 16, SolverKind::automatic);
    const std::vector<int> asked = std::same_as<S, double> ? std::vector{4, 8, 12} : std::vector{8, 16, 24};
    for (const int tolerance : asked)
      for (const long steps : {1L, 16L}) {
        const State<S> state = after("bulirsch_stoer:" + std::to_string(tolerance), scene, S(1) / S(steps), steps);
        const double found = -std::log10(approximately(distance(state.q, exact.q)));
        EXPECT_GE(found, tolerance - 1.5) << name << ' ' << tolerance << ' ' << steps;
        if (steps == 1) {
          EXPECT_LE(found, tolerance + 6) << name << ' ' << tolerance;
        }
      }
  }
}

TEST(BulirschStoer, IsEndedByASignalBetweenParts) {
  SceneSteps<double> kepler(load_scene("kepler"), "bulirsch_stoer:10");
  interruption = SIGTERM;
  EXPECT_THROW(kepler.step(100), Interrupted);
  EXPECT_EQ(kepler.step(1.0 / 1'024).sweeps, 1);
  interruption = 0;
}

/// Powers of 2 of length and time change nothing but the units.
TEST(BulirschStoer, DoesTheSameInOtherUnits) {
  const auto run = [](const char* length, const char* speed, const char* gravity, double h) {
    const std::string text = fmt::format(
        "dimension = 2\npoint = [{{ name = \"o\", position = [0, 0] }}]\n"
        "body = [{{ name = \"a\", mass = 1, position = [\"{0}\", 0], velocity = [0, \"{1}\"] }}]\n"
        "constraint = [{{ kind = \"rod\", between = [\"a\", \"o\"], length = \"{0}\" }}]\n"
        "effect = [{{ kind = \"uniform_gravity\", acceleration = [0, \"-{2}\"] }}]\n",
        length, speed, gravity);
    SceneSteps<double> pendulum(read_scene(text, "a pendulum"), "bulirsch_stoer:10");
    long tries = 0;
    for (int n = 0; n < 3; ++n) tries += pendulum.step(h).sweeps;
    return std::pair(pendulum.state.q, tries);
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
  SceneSteps<double> falling(load_scene("kepler"), "bulirsch_stoer:10");
  falling.state.p.setZero();
  EXPECT_THROW(falling.step(10), StageFailure);
  EXPECT_EQ(falling.state.q, falling.scene.q0);
}

}  // namespace
}  // namespace hbvm::core
