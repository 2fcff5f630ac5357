#include "run/proof/prove_steps.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"
#include "runs/proof/discrete_motion.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

struct Asked {
  Asked(const std::string& name, HbvmName of_method, const std::string& of_step, const std::string& of_until,
        int of_digits)
      : scene(load_scene(name)), steps{scene, of_method, Expression::parse(of_step), Expression::parse(of_until)} {
    steps.digits = of_digits;
  }
  Asked(const Asked&) = delete;

  /// The proof, beside an end that is the start.
  ProvedSteps prove() const {
    const PrecisionScope more(60);
    const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
    return prove_steps(steps, State<Mpfr>(assembled.q0, assembled.p0));
  }

  Scene scene;
  StepsToProve steps;
};

/// Texts are right to half a unit of the last of so many digits of the greatest component.
void expect_right(const std::vector<std::string>& texts, const Vector<Mpfr>& exact, int digits) {
  ASSERT_EQ(static_cast<Index>(texts.size()), exact.size());
  using std::floor, std::log10, std::pow;
  const Mpfr unit = pow(Mpfr(10), Mpfr(floor(log10(max_norm(exact))) - digits + 1));
  for (Index i = 0; i < exact.size(); ++i)
    EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(texts[static_cast<std::size_t>(i)]) - exact[i])), unit) << texts[0];
}

/// A hundred steps, in 30 digits: g and H are as the theory has them.
TEST(ProveSteps, OfAHundredSteps) {
  struct Known {
    const char* scene;
    HbvmName method;
    bool keeps_H, keeps_g;
  };
  for (const Known& c : {Known{"tethered_satellites", {5, 3, 0}, false, true},
                         Known{"heavy_top", {3, 3, 0}, true, true}, Known{"bead_on_torus", {4, 3, 5}, true, false}}) {
    SCOPED_TRACE(c.scene);
    const Asked asked(c.scene, c.method, "0.1", "10", 30);
    const ProvedSteps proved = asked.prove();
    EXPECT_EQ(proved.steps, 100);
    EXPECT_EQ(proved.digits, 30);
    EXPECT_LT(proved.growth, 15);
    EXPECT_GT(std::stod(proved.only_within), 1e-4);
    for (const std::string& radius : {proved.q_radius, proved.p_radius, proved.lambda_radius})
      EXPECT_LT(std::stod(radius), 1e-29);
    EXPECT_EQ(proved.e_H_least.empty(), c.keeps_H) << proved.e_H;
    EXPECT_EQ(proved.e_g_least.empty(), c.keeps_g) << proved.e_g;
    EXPECT_LT(std::stod(proved.e_H), c.keeps_H ? 1e-30 : 1.1 * std::stod(proved.e_H_least));
    EXPECT_LT(std::stod(proved.e_g), c.keeps_g ? 1e-30 : 1.1 * std::stod(proved.e_g_least));
    const PrecisionScope digits(30);
    const HbvmName name{c.method.k, c.method.s, c.method.r == 0 ? c.method.s : c.method.r};
    DiscreteMotion motion(asked.scene, name, "0.1");
    for (int n = 0; n < 100; ++n) motion.step();
    expect_right(proved.q, motion.state().q, 30);
    expect_right(proved.p, motion.state().p, 30);
    expect_right(proved.lambda, motion.multiplier(), 30);
  }
}

/// With too few nodes H changes, and by how much is between bounds.
TEST(ProveSteps, SaysWhatIsNotConserved) {
  const ProvedSteps proved = Asked("tethered_satellites", {1, 1, 0}, "1/10", "1", 15).prove();
  EXPECT_FALSE(proved.e_H_least.empty());
  EXPECT_GT(std::stod(proved.e_H_least), 1e-6);
  EXPECT_LT(std::stod(proved.e_H), 1.05 * std::stod(proved.e_H_least));
  EXPECT_TRUE(proved.e_g_least.empty());
}

/// The run's own end is off by its distance from the exact one.
TEST(ProveSteps, MeasureTheEndOfTheRun) {
  const Asked asked("double_pendulum", {3, 2, 0}, "1/10", "1", 20);
  const PrecisionScope digits(40);
  DiscreteMotion motion(asked.scene, {3, 2, 2}, "1/10");
  for (int n = 0; n < 10; ++n) motion.step();
  State<Mpfr> end = motion.state();
  EXPECT_LT(std::stod(prove_steps(asked.steps, end).off_q), 1e-38);
  end.q[1] += literal<Mpfr>("3e-12");
  const ProvedSteps proved = prove_steps(asked.steps, end);
  EXPECT_NEAR(std::stod(proved.off_q), 3e-12, 3e-14);
  EXPECT_LT(std::stod(proved.off_p), 1e-38);
}

/// Back in time the steps are those from (q, -p).
TEST(ProveSteps, GoBackInTime) {
  Asked asked("double_pendulum", {3, 2, 0}, "1/10", "1", 20);
  asked.steps.direction = Direction::backward;
  const PrecisionScope digits(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(asked.scene);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(3, 2);
  HbvmStepper<Mpfr> stepper(scene.problem, method, SolverKind::automatic);
  State<Mpfr> state(scene.q0, -scene.p0);
  const Mpfr h = Mpfr(1) / 10;
  for (int n = 0; n < 10; ++n) stepper.step(state, h);
  state.p = -state.p;
  const ProvedSteps proved = prove_steps(asked.steps, state);
  expect_right(proved.q, state.q, 20);
  expect_right(proved.p, state.p, 20);
  EXPECT_LT(std::stod(proved.off_p), 1e-35);
}

/// A motion that magnifies errors takes more digits, which are found.
TEST(ProveSteps, TakesAsManyDigitsAsTheMotion) {
  const ProvedSteps proved = Asked("chaotic_double_pendulum", {2, 2, 0}, "1/4", "150", 15).prove();
  EXPECT_GT(proved.working_digits, 35);
  EXPECT_EQ(proved.steps, 600);
  EXPECT_GT(proved.growth, 20);
  EXPECT_LT(std::stod(proved.q_radius), 1e-14);
}

TEST(ProveSteps, TellsItsProgress) {
  Asked asked("double_pendulum", {2, 2, 0}, "1/5", "1", 15);
  std::vector<long> seen;
  asked.steps.progress = [&](long done, long of) {
    EXPECT_EQ(of, 5);
    seen.push_back(done);
  };
  asked.prove();
  EXPECT_EQ(seen, (std::vector<long>{1, 2, 3, 4, 5}));
}

TEST(ProveSteps, NeedAnExactStart) {
  Asked asked("double_pendulum", {2, 2, 0}, "1/5", "1", 30);
  asked.scene =
      read_scene("dimension = 2\n" + point("o", "[0, 0]") +
                     body("a", "1", "[\"0.70710678118654752440\", \"-0.70710678118654752440\"]", "[0, 0]") +
                     "[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"a\"]\nlength = 1\n" + field("[0, -1]"),
                 "rounded");
  expect_words(message_of([&] { asked.prove(); }), {"'rounded'", "no exact start", "sqrt(1/2)"});
}

/// At this step the equations have a solution, and all on a line about it are solutions as well.
TEST(ProveSteps, RefuseAStepWithMoreThanOneSolution) {
  Asked asked("double_pendulum", {1, 1, 0}, "2", "2", 15);
  asked.scene = read_scene("dimension = 2\n" + body("a", "1", "[1, 0]", "[-1, 0]") + formula("x^2/2"), "inverted");
  expect_words(message_of<IntegrationError>([&] { asked.prove(); }),
               {"step 1", "t = 0", "not proved", "one only", "smaller step"});
  asked.steps.step = Expression::parse("1");
  EXPECT_EQ(asked.prove().steps, 2);
}

/// Where the solver finds none the step is told, too.
TEST(ProveSteps, RefuseAStepWithoutSolution) {
  const Asked asked("kepler", {4, 4, 0}, "3", "30", 15);
  expect_words(message_of<IntegrationError>([&] { asked.prove(); }), {"step 1", "t = 0", "smaller step"});
}

}  // namespace
}  // namespace hbvm::core
