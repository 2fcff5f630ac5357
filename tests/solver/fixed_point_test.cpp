#include "solver/fixed_point.hpp"

#include <cmath>

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "solver/error_of.hpp"
#include "solver/falling_stone.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// The simple pendulum with this momentum at its lowest point.
Scene swinging(const std::string& p0) {
  return read_scene(
      "dimension = 2\n[[point]]\nname = \"O\"\nposition = [0, 0]\n[[body]]\nname = \"bob\"\nmass = 1\n"
      "position = [0, -1]\nvelocity = [\"" +
          p0 +
          "\", 0]\n[[constraint]]\nkind = \"rod\"\nbetween = [\"O\", \"bob\"]\n"
          "length = 1\n[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n",
      "swinging");
}

const std::vector<SolverKind> kinds{SolverKind::fixed_point, SolverKind::paper};

TEST(BeyondBreakdown, IsATypedErrorThatNamesStepTimeAndIncrement) {
  for (const int s : {1, 2, 4})
    for (const SolverKind kind : kinds) {
      SceneRun<double> run(swinging("3"), s, s, "3/2", "15", kind);
      const auto error = error_of<StepError>([&] { run({}); });
      const std::string what = error.what();
      EXPECT_GE(error.step(), 1);
      EXPECT_LE(error.step(), 10);
      EXPECT_EQ(error.time(), to_text(run.grid.time(error.step() - 1)));
      expect_words(what, {"step " + std::to_string(error.step()), "t = " + error.time(),
                          "increment " + error.increment(), "smaller step"});
      const double increment = std::stod(error.increment());
      EXPECT_TRUE(increment > 1e-10 || !std::isfinite(increment)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
}

TEST(BeyondBreakdown, TheStateStaysAsItWas) {
  for (const SolverKind kind : kinds) {
    SceneSteps<double> pendulum(swinging("3"), "hbvm:1,1", kind);
    EXPECT_THROW(pendulum.step(1.5), StageFailure);
    pendulum.expect_start();
    EXPECT_EQ(max_norm(pendulum.state.q_carry), 0);
    EXPECT_EQ(max_norm(pendulum.state.p_carry), 0);
  }
}

TEST(BeyondBreakdown, AStepFromThereWithAnotherSizeSucceeds) {
  SceneSteps<double> large(swinging("3"), "hbvm:2,2", SolverKind::fixed_point),
      small(swinging("3"), "hbvm:2,2", SolverKind::fixed_point);
  EXPECT_THROW(large.step(1.5), StageFailure);
  EXPECT_NO_THROW(small.stepper->step(large.state, 0.1));
}

/// Whatever the step: a finite state that fulfils the constraint and keeps H, or a StageFailure.
TEST(AnyStep, SucceedsOrFailsButNeverLies) {
  int solved = 0, failed = 0;
  for (const char* p0 : {"1/10", "1", "3", "10"}) {
    const Assembled<double> scene = assemble<double>(swinging(p0));
    for (const auto& [k, s] : std::vector<std::pair<int, int>>{{1, 1}, {2, 2}, {4, 2}, {3, 3}, {4, 4}, {10, 8}}) {
      const Hbvm<double> method = make_hbvm<double>(k, s);
      for (const SolverKind kind : kinds)
        for (int eighths = 1; eighths <= 40; ++eighths) {
          HbvmStepper<double> stepper(scene.problem, method, kind);
          State<double> state(scene.q0, scene.p0);
          const double H0 = scene.p0.squaredNorm() / 2 + scene.q0[1];
          try {
            for (int step = 0; step < 4; ++step) {
              const Vector<double>& lambda = *stepper.step(state, eighths / 8.0).multiplier;
              ++solved;
              ASSERT_TRUE(state.q.allFinite() && state.p.allFinite() && lambda.allFinite());
              EXPECT_NEAR(state.q.squaredNorm(), 1, 1e-9)
                  << "p0 = " << p0 << ", h = " << eighths / 8.0 << ", " << k << "," << s;
              EXPECT_NEAR(state.p.squaredNorm() / 2 + state.q[1], H0, 1e-9 * (1 + H0))
                  << "p0 = " << p0 << ", h = " << eighths / 8.0 << ", " << k << "," << s;
            }
          } catch (const StageFailure& failure) {
            ++failed;
            EXPECT_GE(failure.sweeps(), 2);
          }
        }
    }
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(failed, 100);
}

/// Two bodies on circles that know nothing of one another. What the Gram matrix makes of their masses and radii is no
/// condition that excuses rounding. The step that is too long for one fails beside the other, too.
TEST(BeyondBreakdown, UnequalBodiesExcuseNothing) {
  const std::string fast = R"toml(
[[body]]
name = "fast"
mass = 1
position = ["3/5000", "-4/5000"]
velocity = ["4/5000", "3/5000"]
[[constraint]]
kind = "quadric"
body = "fast"
A = [[1, 0], [0, 1]]
b = [0, 0]
c = "-10^(-6)"
)toml",
                    light = R"toml(
[[body]]
name = "light"
mass = "10^(-16)"
position = ["3/5", "4/5"]
velocity = ["-4/500", "3/500"]
[[constraint]]
kind = "quadric"
body = "light"
A = [[1, 0], [0, 1]]
b = [0, 0]
c = -1
)toml",
                    gravity = "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, \"-1/5\"]\n";
  for (const std::string& bodies : {fast, fast + light, light + fast})
    for (const SolverKind kind : kinds) {
      SceneSteps<double> circles(read_scene("dimension = 2\n" + bodies + gravity, "bodies"), "hbvm:4,4", kind);
      EXPECT_THROW(circles.step(1.5), StageFailure) << circles.scene.problem.nu() << " constraints";
    }
}

/// Near the breakdown the increments fall slowly, and once rise on the way. "Stop at the first increment that does not
/// fall" ends after two sweeps with an error of 0.3.
TEST(NearBreakdown, AStepIsSolvedCompletely) {
  for (const auto& [s, h] : {std::pair(1, "0.6"), {2, "0.77"}, {4, "1.05"}})
    for (const SolverKind kind : kinds) {
      const PrecisionScope digits(40);
      const std::string method = HbvmName{s, s}.text();
      const double step = literal<double>(h);
      SceneSteps<double> found(swinging("3"), method, kind);
      for (int n = 0; n < 5; ++n) {
        SceneSteps<Mpfr> exact(swinging("3"), method, SolverKind::fixed_point);
        exact.state = State<Mpfr>(found.state.q.cast<Mpfr>(), found.state.p.cast<Mpfr>());
        exact.step(Mpfr(step));
        found.step(step);
        const auto miss = [](const Vector<double>& a, const Vector<Mpfr>& b) {
          return distance(Vector<Mpfr>(a.cast<Mpfr>()), b);
        };
        EXPECT_LE(miss(found.state.q, exact.state.q), literal<Mpfr>("1e-12")) << "s = " << s << ", step " << n + 1;
        EXPECT_LE(miss(found.state.p, exact.state.p), literal<Mpfr>("1e-12")) << "s = " << s << ", step " << n + 1;
      }
    }
}

TEST(FixedPoint, ReturnsTheNumberOfSweeps) {
  for (const SolverKind kind : kinds) {
    SceneSteps<double> coarse(swinging("1"), "hbvm:2,2", kind), fine(swinging("1"), "hbvm:2,2", kind);
    const long many = coarse.step(0.5).sweeps, few = fine.step(0.01).sweeps;
    EXPECT_GE(few, 3);
    EXPECT_LT(few, many);
    EXPECT_LT(many, 200);
  }
}

TEST(FixedPoint, SweepsGrowLinearlyWithTheDigits) {
  std::vector<long> sweeps;
  for (const unsigned n : {50u, 100u, 200u}) {
    const PrecisionScope digits(n);
    SceneSteps<Mpfr> pendulum(swinging("1"), "hbvm:2,2", SolverKind::paper);
    sweeps.push_back(pendulum.step(Mpfr(1) / 10).sweeps);
  }
  EXPECT_GT(sweeps[1], sweeps[0]);
  EXPECT_NEAR(static_cast<double>(sweeps[2] - sweeps[1]), 2.0 * static_cast<double>(sweeps[1] - sweeps[0]), 6);
}

TEST(FixedPoint, AtRestNothingMoves) {
  for (const SolverKind kind : kinds) {
    SceneSteps<double> pendulum(swinging("0"), "hbvm:3,3", kind);
    StepResult<double> last;
    for (int n = 0; n < 10; ++n) last = pendulum.step(0.1);
    EXPECT_EQ(pendulum.state.q, pendulum.scene.q0);
    EXPECT_NEAR(max_norm(pendulum.state.p), 0, 1e-16);
    EXPECT_NEAR((*last.multiplier)[0], 0.5, 1e-14);
  }
}

/// A body that starts from rest: in the paper's order psi lags, and the first sweep from 0 changes no momentum.
TEST(FixedPoint, ThePapersOrderWaitsForTheForceOfABodyAtRest) {
  SceneSteps<double> ours(falling_stone("1"), "hbvm:4,2", SolverKind::fixed_point),
      papers(falling_stone("1"), "hbvm:4,2", SolverKind::paper);
  for (auto* const stone : {&ours, &papers}) stone->step(0.1);
  EXPECT_LT(papers.state.p[0], -0.1);
  EXPECT_LE(std::abs(ours.state.p[0] - papers.state.p[0]), 4 * epsilon<double>() * std::abs(ours.state.p[0]));
}

/// A light body moves as if it were alone, whoever else is in the scene: the digits of the paper's order, too.
TEST(FixedPoint, ALightBodysDigitsDoNotDependOnAHeavyOne) {
  const auto kepler = [](const std::string& mass, const std::string& beside) {
    return read_scene("dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = " +
                          mass + ", position = [\"1/2\", 0], velocity = [0, \"sqrt(3)\"] }" + beside +
                          "]\neffect = [{ kind = \"central_gravity\", center = \"O\", strength = 1, on = [\"a\"] }]\n",
                      "kepler");
  };
  const std::string heavy = ", { name = \"b\", mass = 1, position = [0, 10], velocity = [1, 0] }";
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::paper, SolverKind::newton})
    for (const std::string mass : {"\"2^(-30)\"", "\"2^(-100)\""}) {
      SceneSteps<double> alone(kepler(mass, ""), "hbvm:6,2", kind), beside(kepler(mass, heavy), "hbvm:6,2", kind);
      for (auto* const scene : {&alone, &beside})
        for (int n = 0; n < 100; ++n) scene->step(0.1);
      const State<double>&one = alone.state, &two = beside.state;
      for (Index j = 0; j < 2; ++j) {
        // A hundred steps' rounding, and what the orbit makes of it.
        EXPECT_LE(std::abs(one.q[j] - two.q[j]), 10'000 * epsilon<double>()) << name_of(kind);
        EXPECT_LE(std::abs(one.p[j] - two.p[j]), 10'000 * epsilon<double>() * max_norm(one.p)) << name_of(kind);
      }
    }
}

}  // namespace
}  // namespace hbvm::core
