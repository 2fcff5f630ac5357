#include "solver/newton.hpp"

#include "integrate/drift.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "solver/falling_stone.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <class S>
class NewtonTest : public InDigits<50> {};
TYPED_TEST_SUITE(NewtonTest, AllScalars, ScalarNames);

/// The pendulum that goes over the top, with steps at which the fixed point has no chance. U is linear, so that H and g
/// are conserved to round-off.
TYPED_TEST(NewtonTest, ConvergesWhereTheFixedPointBreaksDown) {
  using S = TypeParam;
  for (const auto& [s, step] : {std::pair(1, "3/2"), {2, "2"}, {4, "2"}, {6, "2"}})
    for (const int k : {s, s + 3})
      for (const SolverKind kind : {SolverKind::newton, SolverKind::automatic}) {
        SceneRun<S> run(load_scene("swinging_pendulum"), k, s, step, "60", kind);
        Drift<S> drift(run.scene.problem);
        ASSERT_NO_THROW(run({&drift})) << s << " " << name_of(kind);
        // H is 3.5, and 30 to 40 steps add their round-off.
        EXPECT_LE(drift.e_H(), 200 * epsilon<S>()) << k << "," << s;
        EXPECT_LE(drift.e_g(), 100 * epsilon<S>()) << k << "," << s;
      }
}

TYPED_TEST(NewtonTest, EndsWithATypedErrorWhereNoSolutionIsFound) {
  for (const SolverKind kind : {SolverKind::newton, SolverKind::automatic}) {
    SceneRun<TypeParam> run(load_scene("swinging_pendulum"), 1, 1, "3", "30", kind);
    EXPECT_THROW(run({}), StepError);
  }
}

/// Where a start in double leaves no more than rounding, there is no rate to be seen, and none that is too slow.
TEST(Newton, StaysInDoubleWhereItsStartIsGood) {
  for (const unsigned digits : {18U, 20U, 22U, 26U}) {
    const PrecisionScope scope(digits);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(4, 4);
    for (const char* step : {"1/10", "10/256", "10/362", "1/100", "1/1000"}) {
      Newton<Mpfr> newton(scene.problem, method);
      const Mpfr h = literal<Mpfr>(step);
      newton.solve({scene.q0, scene.p0, h});
      for (const PartCount& part : newton.counts().parts)
        EXPECT_TRUE(part.in_double || part.name != "factors of the Jacobian") << digits << " " << step;
    }
  }
}

/// A body dropped next to a centre of gravity: a tiny increment of an enormous unknown is no solution.
TEST(Newton, TakesNoSmallIncrementForASolution) {
  for (const SolverKind kind : {SolverKind::newton, SolverKind::automatic}) {
    SceneSteps<double> fall(falling_stone("1e-9"), "hbvm:2,2", kind);
    EXPECT_THROW(fall.step(1), StageFailure) << name_of(kind);
  }
}

const PartCount& part_named(const SolverCounts& counts, const std::string& name) {
  const auto found =
      std::find_if(counts.parts.begin(), counts.parts.end(), [&](const PartCount& part) { return part.name == name; });
  if (found == counts.parts.end()) throw std::out_of_range("no part " + name);
  return *found;
}

long sweeps_in_double(const SceneSteps<Mpfr>& steps) {
  return static_cast<long>(part_named(steps.stepper->counts(), "stage equations").calls);
}

/// Each sweep wins some fourteen digits. 25 digits more take one or two sweeps more in many digits, and with those in
/// double there are far fewer than the fixed point's.
TEST(Newton, WinsFourteenDigitsASweep) {
  long last = 0;
  for (const unsigned digits : {25U, 50U, 75U, 100U, 200U}) {
    const PrecisionScope scope(digits);
    const Mpfr h = Mpfr(1) / 10;
    SceneSteps<Mpfr> newton(load_scene("tethered_satellites"), "hbvm:6,4", SolverKind::newton),
        papers(load_scene("tethered_satellites"), "hbvm:6,4", SolverKind::paper);
    newton.step(h);
    papers.step(h);
    const long in_double = sweeps_in_double(newton);
    const long all = newton.step(h).sweeps, papers_sweeps = papers.step(h).sweeps;
    const long sweeps = all - (sweeps_in_double(newton) - in_double);
    if (digits == 100) {
      EXPECT_LE(all, 17);
      EXPECT_GE(papers_sweeps, 50);
    }
    EXPECT_LE(sweeps, last == 0 ? 2 : last + (digits == 200 ? 8 : 2)) << digits;
    last = sweeps;
    EXPECT_LE(distance(newton.state.q, papers.state.q), 10'000 * epsilon<Mpfr>());
    EXPECT_LE(distance(newton.state.p, papers.state.p), 10'000 * epsilon<Mpfr>());
  }
}

/// The account holds the sweeps of all precisions, those in double apart: each evaluates the force at k nodes, and has
/// one correction.
TEST(Newton, CountsWhatItDid) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("kepler"));
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(5, 2);
  const auto solver = make_solver(SolverKind::newton, scene.problem, method);
  const auto sweeps = static_cast<std::uint64_t>(solver->solve({scene.q0, scene.p0, Mpfr(Mpfr(1) / 50)}));
  const SolverCounts counts = solver->counts();
  const auto part = [&](const std::string& name) { return part_named(counts, name); };
  EXPECT_EQ(counts.effects.at(0).evaluations, 5 * (sweeps - part("stage equations").calls));
  EXPECT_LT(part("stage equations").calls, sweeps);
  for (const char* name : {"stage equations", "matrix of the Jacobian", "factors of the Jacobian", "corrections"})
    EXPECT_TRUE(part(name).in_double && part(name).calls > 0) << name;
  EXPECT_EQ(part("corrections").calls, sweeps);
  EXPECT_EQ(part("matrix of the Jacobian").calls, part("factors of the Jacobian").calls);
  EXPECT_GE(part("factors of the Jacobian").calls, 1u);
  EXPECT_LT(part("factors of the Jacobian").calls, sweeps);
  // 4 unknowns, 2 coordinates of 2 stages each: the entries of L and U, and the reciprocals of the pivots
  EXPECT_EQ(part("corrections").per_call[Op::multiply], 12u + 4u);
}

/// Where the motion turns uniformly, the increments of the third step fall fast once and then no more. To take the
/// first fall for the rate of all would leave an error that shows in the angular momentum.
TEST(Newton, IsNotMisledByOneFastFall) {
  SceneSteps<double> pendulum(load_scene("conical_pendulum"), "hbvm:3,3", SolverKind::newton);
  const State<double>& state = pendulum.state;
  const auto momentum = [&] { return state.q[0] * state.p[1] - state.q[1] * state.p[0]; };
  const double before = momentum();
  for (int n = 0; n < 64; ++n) pendulum.step(1.0 / 16);
  EXPECT_LE(std::abs(momentum() - before), 16 * epsilon<double>());
}

/// Numbers that double does not hold: Newton fails, typed, and the automatic solver goes on with the fixed point.
TEST(Newton, LeavesWhatDoubleCannotHoldToTheFixedPoint) {
  const PrecisionScope digits(40);
  const Scene text = read_scene(
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, position = [1, "
      "0], "
      "velocity = [0, \"10^(-400)\"] }]\nconstraint = [{ kind = \"rod\", between = [\"O\", \"a\"], length = 1 }]\n",
      "slow");
  const Assembled<Mpfr> scene = assemble<Mpfr>(text);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(2, 2);
  const auto solver = make_solver(SolverKind::automatic, scene.problem, method);
  EXPECT_NO_THROW(solver->solve({scene.q0, scene.p0, Mpfr(Mpfr(1) / 10)}));
  EXPECT_LE(magnitude(Mpfr(solver->change().q[1] / scene.p0[1] - Mpfr(1) / 10)), 100 * epsilon<Mpfr>());
}

/// The last residual is one of the full precision, and nothing of it is left. Every sweep of the fixed point is one of
/// the full precision: both steps agree to a few roundings of each coordinate.
TEST(Newton, EndsAtTheLastDigit) {
  for (const unsigned digits : {20U, 40U, 62U, 100U}) {
    const PrecisionScope scope(digits);
    for (const char* name : {"double_pendulum", "kepler"}) {
      const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
      const State<Mpfr> newtons = after("hbvm:4,3", scene, Mpfr(1) / 16, 3),
                        swept = after("hbvm:4,3", scene, Mpfr(1) / 16, 3, SolverKind::fixed_point);
      const Mpfr size = std::max(max_norm(swept.p), max_norm(swept.q));
      EXPECT_LE(distance(newtons.p, swept.p), 24 * epsilon<Mpfr>() * size) << name << ", " << digits;
      EXPECT_LE(distance(newtons.q, swept.q), 24 * epsilon<Mpfr>() * size) << name << ", " << digits;
    }
  }
}

/// A stiff spring, omega h = 1250: Gauss methods are stable there, and the solution near the start is the one that is
/// meant. It was 1500 times too fast.
TYPED_TEST(NewtonTest, TakesTheSolutionNearTheStartOnAStiffSpring) {
  using S = TypeParam;
  const Scene stiff = read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, position = "
      "[\"3/5\", \"-4/5\"], velocity = [\"2/5\", \"3/10\"] }]\neffect = [{ kind = \"uniform_gravity\", acceleration = "
      "[0, -1] }, { kind = \"spring\", between = [\"o\", \"a\"], stiffness = \"10^8\", rest_length = 1 }]\n",
      "stiff");
  for (const int s : {1, 2, 3}) {
    SceneSteps<S> spring(stiff, HbvmName{s, s}.text(), SolverKind::newton);
    for (int n = 0; n < 8; ++n) {
      spring.step(S(1) / 8);
      EXPECT_LT(max_norm(spring.state.p), 2) << s;
      EXPECT_LT(magnitude(S(spring.state.q.squaredNorm() - 1)), S(1) / 64) << s;
    }
  }
}

}  // namespace
}  // namespace hbvm::core
