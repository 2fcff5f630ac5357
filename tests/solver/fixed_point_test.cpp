#include "solver/fixed_point.hpp"

#include <cmath>

#include "integrate/integrate.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

/// The simple pendulum with this momentum at its lowest point.
std::string swinging(const std::string& p0) {
  return "dimension = 2\n[[point]]\nname = \"O\"\nposition = [0, 0]\n[[body]]\nname = \"bob\"\nmass = 1\n"
         "position = [0, -1]\nvelocity = [\"" +
         p0 +
         "\", 0]\n[[constraint]]\nkind = \"rod\"\nbetween = [\"O\", \"bob\"]\n"
         "length = 1\n[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n";
}

const std::vector<SolverKind> kinds{SolverKind::fixed_point, SolverKind::paper};

TEST(BeyondBreakdown, IsATypedErrorThatNamesStepTimeAndIncrement) {
  const Assembled<double> scene = assemble<double>(read_scene(swinging("3"), "swinging"));
  for (const int s : {1, 2, 4})
    for (const SolverKind kind : kinds) {
      const Hbvm<double> method = make_hbvm<double>(s, s);
      const TimeGrid<double> grid(Expression::parse("3/2"), Expression::parse("15"));
      HbvmStepper<double> stepper(scene.problem, method, kind);
      State<double> state(scene.q0, scene.p0);
      try {
        integrate<double>(stepper, state, grid, {});
        FAIL() << "no error, s = " << s;
      } catch (const StepError& error) {
        const std::string what = error.what();
        EXPECT_GE(error.step(), 1);
        EXPECT_LE(error.step(), 10);
        EXPECT_NE(what.find("step " + std::to_string(error.step())), std::string::npos) << what;
        EXPECT_EQ(error.time(), to_text(grid.time(error.step() - 1)));
        EXPECT_NE(what.find("t = " + error.time()), std::string::npos) << what;
        EXPECT_NE(what.find("increment " + error.increment()), std::string::npos) << what;
        EXPECT_NE(what.find("smaller step"), std::string::npos) << what;
        const double increment = std::stod(error.increment());
        EXPECT_TRUE(increment > 1e-10 || !std::isfinite(increment)) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      }
    }
}

TEST(BeyondBreakdown, TheStateStaysAsItWas) {
  const Assembled<double> scene = assemble<double>(read_scene(swinging("3"), "swinging"));
  const Hbvm<double> method = make_hbvm<double>(1, 1);
  for (const SolverKind kind : kinds) {
    HbvmStepper<double> stepper(scene.problem, method, kind);
    State<double> state(scene.q0, scene.p0);
    EXPECT_THROW(stepper.step(state, 1.5), StageFailure);
    EXPECT_EQ(state.q, scene.q0);
    EXPECT_EQ(state.p, scene.p0);
    EXPECT_EQ(max_norm(state.q_carry), 0);
    EXPECT_EQ(max_norm(state.p_carry), 0);
  }
}

TEST(BeyondBreakdown, AStepFromThereWithAnotherSizeSucceeds) {
  const Assembled<double> scene = assemble<double>(read_scene(swinging("3"), "swinging"));
  const Hbvm<double> method = make_hbvm<double>(2, 2);
  State<double> state(scene.q0, scene.p0);
  HbvmStepper<double> large(scene.problem, method, SolverKind::fixed_point);
  EXPECT_THROW(large.step(state, 1.5), StageFailure);
  HbvmStepper<double> small(scene.problem, method, SolverKind::fixed_point);
  EXPECT_NO_THROW(small.step(state, 0.1));
}

/// Whatever the step: a finite state that fulfils the constraint and keeps H, or a StageFailure.
TEST(AnyStep, SucceedsOrFailsButNeverLies) {
  int solved = 0, failed = 0;
  for (const char* p0 : {"1/10", "1", "3", "10"}) {
    const Assembled<double> scene = assemble<double>(read_scene(swinging(p0), "swinging"));
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
  const Hbvm<double> method = make_hbvm<double>(4, 4);
  for (const std::string& bodies : {fast, fast + light, light + fast}) {
    const Assembled<double> scene = assemble<double>(read_scene("dimension = 2\n" + bodies + gravity, "bodies"));
    for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::paper}) {
      HbvmStepper<double> stepper(scene.problem, method, kind);
      State<double> state(scene.q0, scene.p0);
      EXPECT_THROW(stepper.step(state, 1.5), StageFailure) << scene.problem.nu() << " constraints";
    }
  }
}

/// Near the breakdown the increments fall slowly, and once rise on the way. "Stop at the first increment that does not
/// fall" ends after two sweeps with an error of 0.3.
TEST(NearBreakdown, AStepIsSolvedCompletely) {
  struct Case {
    int s;
    const char* h;
  };
  for (const Case c : {Case{1, "0.6"}, Case{2, "0.77"}, Case{4, "1.05"}})
    for (const SolverKind kind : kinds) {
      const PrecisionScope digits(40);
      const Assembled<double> scene = assemble<double>(read_scene(swinging("3"), "swinging"));
      const Assembled<Mpfr> exact_scene = assemble<Mpfr>(read_scene(swinging("3"), "swinging"));
      const Hbvm<double> method = make_hbvm<double>(c.s, c.s);
      const Hbvm<Mpfr> exact_method = make_hbvm<Mpfr>(c.s, c.s);
      HbvmStepper<double> stepper(scene.problem, method, kind);
      State<double> state(scene.q0, scene.p0);
      const Mpfr step(literal<double>(c.h));
      for (int n = 0; n < 5; ++n) {
        State<Mpfr> exact(state.q.cast<Mpfr>(), state.p.cast<Mpfr>());
        HbvmStepper<Mpfr>(exact_scene.problem, exact_method, SolverKind::fixed_point).step(exact, step);
        stepper.step(state, literal<double>(c.h));
        const Mpfr miss = max_norm(Vector<Mpfr>(state.q.cast<Mpfr>() - exact.q)),
                   miss_p = max_norm(Vector<Mpfr>(state.p.cast<Mpfr>() - exact.p));
        EXPECT_LE(miss, literal<Mpfr>("1e-12")) << "s = " << c.s << ", step " << n + 1;
        EXPECT_LE(miss_p, literal<Mpfr>("1e-12")) << "s = " << c.s << ", step " << n + 1;
      }
    }
}

TEST(FixedPoint, ReturnsTheNumberOfSweeps) {
  const Assembled<double> scene = assemble<double>(read_scene(swinging("1"), "swinging"));
  const Hbvm<double> method = make_hbvm<double>(2, 2);
  for (const SolverKind kind : kinds) {
    const auto coarse = make_solver(kind, scene.problem, method), fine = make_solver(kind, scene.problem, method);
    const long many = coarse->solve({scene.q0, scene.p0, 0.5}), few = fine->solve({scene.q0, scene.p0, 0.01});
    EXPECT_GE(few, 3);
    EXPECT_LT(few, many);
    EXPECT_LT(many, 200);
  }
}

TEST(FixedPoint, SweepsGrowLinearlyWithTheDigits) {
  std::vector<long> sweeps;
  for (const unsigned n : {50u, 100u, 200u}) {
    const PrecisionScope digits(n);
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(swinging("1"), "swinging"));
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(2, 2);
    sweeps.push_back(
        make_solver(SolverKind::paper, scene.problem, method)->solve({scene.q0, scene.p0, Mpfr(Mpfr(1) / 10)}));
  }
  EXPECT_GT(sweeps[1], sweeps[0]);
  EXPECT_NEAR(static_cast<double>(sweeps[2] - sweeps[1]), 2.0 * static_cast<double>(sweeps[1] - sweeps[0]), 6);
}

TEST(FixedPoint, AtRestNothingMoves) {
  const Assembled<double> scene = assemble<double>(read_scene(swinging("0"), "at rest"));
  const Hbvm<double> method = make_hbvm<double>(3, 3);
  for (const SolverKind kind : kinds) {
    HbvmStepper<double> stepper(scene.problem, method, kind);
    State<double> state(scene.q0, scene.p0);
    StepResult<double> last;
    for (int n = 0; n < 10; ++n) last = stepper.step(state, 0.1);
    EXPECT_EQ(state.q, scene.q0);
    EXPECT_NEAR(max_norm(state.p), 0, 1e-16);
    EXPECT_NEAR((*last.multiplier)[0], 0.5, 1e-14);
  }
}

/// A body that starts from rest: in the paper's order psi lags, and the first sweep from 0 changes no momentum.
TEST(FixedPoint, ThePapersOrderWaitsForTheForceOfABodyAtRest) {
  const Assembled<double> scene = assemble<double>(read_scene(
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, position = [1, "
      "0], velocity = [0, 0] }]\neffect = [{ kind = \"central_gravity\", center = \"O\", strength = 1 }]\n",
      "fall"));
  const Hbvm<double> method = make_hbvm<double>(4, 2);
  State<double> states[2] = {{scene.q0, scene.p0}, {scene.q0, scene.p0}};
  for (std::size_t i = 0; i < 2; ++i) HbvmStepper<double>(scene.problem, method, kinds[i]).step(states[i], 0.1);
  EXPECT_LT(states[1].p[0], -0.1);
  EXPECT_LE(std::abs(states[0].p[0] - states[1].p[0]), 4 * epsilon<double>() * std::abs(states[0].p[0]));
}

/// A light body moves as if it were alone, whoever else is in the scene: the digits of the paper's order, too.
TEST(FixedPoint, ALightBodysDigitsDoNotDependOnAHeavyOne) {
  const auto kepler = [](const std::string& mass, const std::string& beside) {
    return "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = " + mass +
           ", position = [\"1/2\", 0], velocity = [0, \"sqrt(3)\"] }" + beside +
           "]\neffect = [{ kind = \"central_gravity\", center = \"O\", strength = 1, on = [\"a\"] }]\n";
  };
  const std::string heavy = ", { name = \"b\", mass = 1, position = [0, 10], velocity = [1, 0] }";
  const Hbvm<double> method = make_hbvm<double>(6, 2);
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::paper, SolverKind::newton}) {
    for (const std::string mass : {"\"2^(-30)\"", "\"2^(-100)\""}) {
      const auto alone = assemble<double>(read_scene(kepler(mass, ""), "alone")),
                 both = assemble<double>(read_scene(kepler(mass, heavy), "both"));
      State<double> one(alone.q0, alone.p0), two(both.q0, both.p0);
      HbvmStepper<double> first(alone.problem, method, kind), second(both.problem, method, kind);
      for (int n = 0; n < 100; ++n) {
        first.step(one, 0.1);
        second.step(two, 0.1);
      }
      for (Index j = 0; j < 2; ++j) {
        // A hundred steps' rounding, and what the orbit makes of it.
        EXPECT_LE(std::abs(one.q[j] - two.q[j]), 10'000 * epsilon<double>()) << name_of(kind);
        EXPECT_LE(std::abs(one.p[j] - two.p[j]), 10'000 * epsilon<double>() * max_norm(one.p)) << name_of(kind);
      }
    }
  }
}

}  // namespace
}  // namespace hbvm::core
