#include "run/run_stepper.hpp"

#include "integrate/energy_scale.hpp"
#include "printing.hpp"
#include "run/simulate.hpp"
#include "scene/scene_text.hpp"
#include "step/hbvm_method.hpp"
#include "step/registry.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A pendulum that turns over fast: no iteration solves its stage equations for steps of 1.
std::string fast_pendulum() {
  return "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
         "body = [{ name = \"bob\", mass = 1, position = [0, -1], velocity = [8, 0] }]\n"
         "constraint = [{ kind = \"rod\", between = [\"O\", \"bob\"], length = 1 }]\n"
         "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -1] }]\n";
}

/// A charged bob, and a like charge a tenth outside its circle.
std::string charged_pendulum(const std::string& distance) {
  return "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }, { name = \"C\", position = [" + distance +
         ", 0], charge = 1 }]\n"
         "body = [{ name = \"bob\", mass = 1, charge = 1, position = [0, -1], velocity = [\"4\", 0] }]\n"
         "constraint = [{ kind = \"rod\", between = [\"O\", \"bob\"], length = 1 }]\n"
         "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -1] }, { kind = \"coulomb\", strength = -1 }]\n";
}

TEST(OnFailureText, IsReadAndWritten) {
  for (const OnFailure on_failure : {OnFailure::stop, OnFailure::halve})
    EXPECT_EQ(parse_on_failure(name_of(on_failure)), on_failure);
  EXPECT_THROW(parse_on_failure("retry"), InputError);
}

template <class S>
class RunSteps : public InDigits<50> {};
TYPED_TEST_SUITE(RunSteps, AllScalars, ScalarNames);

/// Each substep conserves energy and constraint: at the end of a run whose steps cannot be made whole, both are
/// round-off.
TYPED_TEST(RunSteps, AreDividedWhereTheyFailAndConserve) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(read_scene(fast_pendulum(), "test"));
  const TimeGrid<S> grid(Expression::parse("1"), Expression::parse("12"));
  for (const SolverKind kind : {SolverKind::paper, SolverKind::fixed_point}) {
    RunStepper<S> stops(scene, hbvm_of({2, 2}), grid.step(), kind, OnFailure::stop);
    EXPECT_EQ(stops.halving(), nullptr);
    EXPECT_THROW(simulate<S>(scene, stops, grid), StepError);
    RunStepper<S> halves(scene, hbvm_of({2, 2}), grid.step(), kind, OnFailure::halve);
    EnergyScale<S> scale(scene.problem);
    const Simulated<S> run = simulate<S>(scene, halves, grid, {&scale});
    EXPECT_EQ(run.integration.steps, 12);
    EXPECT_EQ(run.integration.end.t, S(12));
    ASSERT_NE(halves.halving(), nullptr);
    EXPECT_EQ(halves.halving()->steps, 12);
    EXPECT_GE(halves.halving()->depth, 2);
    EXPECT_LE(run.e_H, scale.round_off(halves.halving()->substeps));
    EXPECT_LE(run.e_g, 200 * epsilon<S>());
  }
}

/// Nodes are chosen and raised in the substeps, too.
TYPED_TEST(RunSteps, MayBeDividedAndHaveTheirNodesChosen) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(read_scene(charged_pendulum("\"3/2\""), "test"));
  const TimeGrid<S> grid(Expression::parse("1"), Expression::parse("8"));
  RunStepper<S> stepper(scene, parse_method("hbvm:auto,2"), grid.step(), SolverKind::fixed_point, OnFailure::halve);
  EnergyScale<S> scale(scene.problem);
  const Simulated<S> run = simulate<S>(scene, stepper, grid, {&scale});
  EXPECT_GT(stepper.halving()->steps, 0);
  EXPECT_EQ(stepper.nodes().unresolved, 0);
  EXPECT_LE(run.e_H, scale.round_off(stepper.halving()->substeps));
}

TEST(RunStepsOfAPolynomial, HaveTheExactNodesAndNoneIsRaised) {
  const Assembled<double> scene = assemble<double>(load_scene("quartic_oscillator"));
  RunStepper<double> stepper(scene, parse_method("hbvm:auto,2"), 1.0 / 16, SolverKind::automatic, OnFailure::stop);
  EXPECT_EQ(as_hbvm(*stepper.method())->name().k, 4);
  EXPECT_TRUE(stepper.chosen()->exact);
}

TEST(RunStepsThatCannotBeMade, AtAnySizeFailWithTheirCause) {
  // The bob starts on the charge.
  const Assembled<double> scene =
      assemble<double>(read_scene("dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
                                  "body = [{ name = \"a\", mass = 1, position = [\"2^-100\", 0], velocity = [0, 0] }]\n"
                                  "effect = [{ kind = \"central_gravity\", center = \"O\", strength = \"2^100\" }]\n",
                                  "test"));
  const TimeGrid<double> grid(Expression::parse("1"), Expression::parse("2"));
  RunStepper<double> stepper(scene, hbvm_of({4, 2}), grid.step(), SolverKind::fixed_point, OnFailure::halve);
  try {
    simulate<double>(scene, stepper, grid);
    ADD_FAILURE() << "it was made";
  } catch (const StepError& error) {
    EXPECT_EQ(error.step(), 1);
    EXPECT_EQ(error.cause(), FailureCause::stage_equations_diverge);
    expect_words(std::string(error.what()), {"2^-20"});
  }
}

/// Numbers of many digits have no overflow: what diverges grows until the sine of it cannot be computed.
TEST(RunStepsThatCannotBeMade, InManyDigitsDivergeAsInDouble) {
  const PrecisionScope digits(30);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("tethered_satellites"));
  const TimeGrid<Mpfr> grid(Expression::parse("10"), Expression::parse("20"));
  for (const char* const method : {"energy_momentum", "lobatto:3", "compose:energy_momentum,4"}) {
    SCOPED_TRACE(method);
    RunStepper<Mpfr> stepper(scene, parse_method(method), grid.step(), SolverKind::fixed_point, OnFailure::stop);
    try {
      simulate<Mpfr>(scene, stepper, grid);
      ADD_FAILURE() << "it was made";
    } catch (const StepError& error) {
      EXPECT_EQ(error.step(), 1);
      EXPECT_EQ(error.cause(), FailureCause::stage_equations_diverge);
    }
  }
}

}  // namespace
}  // namespace hbvm::core
