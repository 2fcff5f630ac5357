#include "step/raising_stepper.hpp"

#include "integrate/drift.hpp"
#include "integrate/energy_scale.hpp"
#include "printing.hpp"
#include "problem/general_drift.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A body that comes from afar and passes a center at a distance of about 1/3 about t = 4.
std::string passing(const std::string& mass, const std::string& another = "") {
  return "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
         "body = [{ name = \"a\", mass = " +
         mass + ", position = [-8, \"1/2\"], velocity = [2, 0] }" + another +
         "]\n"
         "effect = [{ kind = \"central_gravity\", center = \"O\", strength = 1 }]\n";
}

/// A run and what it says of itself.
template <Scalar S>
struct Raised {
  Assembled<S> scene;
  NodeLog log;
  RaisingStepper<S> stepper;
  State<S> state;
  Drift<S> drift;
  EnergyScale<S> scale;
  S h;

  Raised(const std::string& toml, int k, int s, const S& step, SolverKind kind = SolverKind::fixed_point)
      : Raised(read_scene(toml, "test"), k, s, step, kind) {}
  Raised(const Scene& text, int k, int s, const S& step, SolverKind kind = SolverKind::fixed_point)
      : scene(assemble<S>(text)),
        stepper(scene.problem, HbvmName{k, s}, kind, log),
        state(scene.q0, scene.p0),
        drift(scene.problem),
        scale(scene.problem),
        h(step) {}

  void run(long steps) {
    Snapshot<S> snapshot{0, S(0), state.q, state.p, {}};
    for (; snapshot.n <= steps; ++snapshot.n) {
      drift.observe(snapshot);
      scale.observe(snapshot);
      if (snapshot.n == steps) break;
      log.step = snapshot.n;
      step();
      snapshot.q = state.q;
      snapshot.p = state.p;
    }
  }
  long step() { return stepper.step(state, h).sweeps; }
  bool conserved(long steps) const { return drift.e_H() <= scale.round_off(steps); }
};

template <class S>
class Raising : public InDigits<50> {};
TYPED_TEST_SUITE(Raising, AllScalars, ScalarNames);

TYPED_TEST(Raising, MakesTheStepsOfTheMethodWhereTheNodesSuffice) {
  using S = TypeParam;
  const S h = S(1) / 32;
  const int k = std::same_as<S, double> ? 12 : 40;
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::automatic}) {
    Raised<S> raised(load_scene("kepler"), k, 2, h, kind);
    raised.run(40);
    EXPECT_TRUE(raised.log.raised.empty());
    EXPECT_EQ(raised.log.unresolved, 0);
    const State<S> state = after(HbvmName{k, 2}.text(), raised.scene, h, 40, kind);
    EXPECT_EQ(raised.state.q, state.q);
    EXPECT_EQ(raised.state.p, state.p);
    EXPECT_EQ(raised.state.p_carry, state.p_carry);
  }
}

/// What suffices far away does not near the center; what was raised conserves the energy.
TYPED_TEST(Raising, RaisesTheNodesWhereTheMotionNeedsThem) {
  using S = TypeParam;
  constexpr long steps = 256;
  const int k = std::same_as<S, double> ? 3 : std::same_as<S, Quad> ? 8 : 12;
  Raised<S> raised(passing("1"), k, 2, S(S(1) / 32));
  raised.run(steps);
  ASSERT_FALSE(raised.log.raised.empty());
  EXPECT_GT(raised.log.raised.back().step, 16);
  int last = k;
  for (const NodeLog::Raise& raise : raised.log.raised) {
    EXPECT_GT(raise.k, last);
    last = raise.k;
  }
  EXPECT_EQ(raised.stepper.k(), last);
  EXPECT_EQ(raised.log.unresolved, 0);
  EXPECT_TRUE(raised.conserved(steps)) << raised.drift.e_H();

  SceneSteps<S> plain(read_scene(passing("1"), "test"), HbvmName{k, 2}.text(), SolverKind::fixed_point);
  Drift<S> drift(plain.scene.problem);
  for (long n = 0; n <= steps; ++n) {
    drift.observe({n, S(n), plain.state.q, plain.state.p, {}});
    plain.step(S(1) / 32);
  }
  EXPECT_GT(drift.e_H(), 1'000 * raised.scale.round_off(steps)) << "the plain method should fail";
}

/// Kept and taken up by another one after every step, and the same to the last bit.
TYPED_TEST(Raising, IsKeptWithAllThatItRemembers) {
  using S = TypeParam;
  constexpr long steps = 200;
  const auto start = [&] {
    return std::make_unique<Raised<S>>(passing("1"), std::same_as<S, double> ? 3 : 12, 2, S(S(1) / 16),
                                       SolverKind::automatic);
  };
  const auto whole = start();
  auto part = start();
  for (long n = 0; n < steps; ++n) {
    Archive kept;
    kept(part->stepper, part->state, part->log);
    Archive reading(kept.text());
    part = start();
    reading(part->stepper, part->state, part->log);
    reading.expect_end();
    for (Raised<S>* const run : {whole.get(), part.get()}) run->log.step = n;
    EXPECT_EQ(part->step(), whole->step()) << n;
    ASSERT_EQ(part->state.p, whole->state.p) << n;
    ASSERT_EQ(part->state.q_carry, whole->state.q_carry) << n;
  }
  EXPECT_GT(whole->log.raised.size(), 1u);
  EXPECT_EQ(part->log.raised.size(), whole->log.raised.size());
  EXPECT_EQ(part->log.raised.back().step, whole->log.raised.back().step);
  const SolverCounts a = part->stepper.counts(), b = whole->stepper.counts();
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) EXPECT_EQ(a.parts[i].calls, b.parts[i].calls) << a.parts[i].name;
}

/// The energy of a planet hides that of a body of 10^-30 of its mass; its nodes do not.
TEST(RaisingForALightBody, BesideAHeavyOneIsAsForItAlone) {
  const std::string heavy = ", { name = \"planet\", mass = 1, position = [0, 40], velocity = [\"1/8\", 0] }";
  Raised<double> alone(passing("1"), 3, 2, 1.0 / 32), beside(passing("\"1e-30\"", heavy), 3, 2, 1.0 / 32);
  alone.run(256);
  beside.run(256);
  ASSERT_FALSE(beside.log.raised.empty());
  EXPECT_GE(beside.stepper.k(), alone.stepper.k() - 2);
}

/// Scaled by powers of two in length, mass and time, the same nodes are raised at the same steps.
TEST(RaisingInOtherUnits, IsTheSame) {
  const std::string scaled =
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = \"2^40\", position = [\"-(2^-27)\", \"2^-31\"], velocity = [\"2^-39\", 0] }]\n"
      "effect = [{ kind = \"central_gravity\", center = \"O\", strength = \"2^-110\" }]\n";
  // Lengths 2^-30, times 2^10: velocities 2^-40, strength (length^3 / time^2) 2^-110.
  Raised<double> one(passing("1"), 3, 2, 1.0 / 32), other(scaled, 3, 2, 32.0);
  one.run(256);
  other.run(256);
  ASSERT_EQ(other.log.raised.size(), one.log.raised.size());
  for (std::size_t i = 0; i < one.log.raised.size(); ++i) {
    EXPECT_EQ(other.log.raised[i].step, one.log.raised[i].step);
    EXPECT_EQ(other.log.raised[i].k, one.log.raised[i].k);
  }
  for (Index j = 0; j < 2; ++j) EXPECT_EQ(std::ldexp(other.state.q[j], 30), one.state.q[j]);
  EXPECT_EQ(other.drift.e_H() / other.scale.round_off(256), one.drift.e_H() / one.scale.round_off(256));
}

/// Round-off that a stiff force amplifies is not reported as a lack of nodes.
TEST(RaisingOfAStiffSpring, IsNoAlarm) {
  const std::string stiff =
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 1, position = [\"3/5\", \"-4/5\"], velocity = [\"4/10\", \"3/10\"] }]\n"
      "effect = [{ kind = \"spring\", between = [\"O\", \"a\"], stiffness = \"10^6\", rest_length = 1 }]\n";
  Raised<double> raised(stiff, 8, 2, 1.0 / 4096, SolverKind::automatic);
  raised.run(2'000);
  EXPECT_EQ(raised.log.unresolved, 0);
  EXPECT_TRUE(raised.conserved(2'000)) << raised.drift.e_H() << " " << raised.scale.round_off(2'000);
}

/// Across r = 9/10, where |r - 9/10|^3 is not smooth, no number of nodes is enough.
const std::string cubic =
    "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
    "body = [{ name = \"a\", mass = 1, position = [2, 0], velocity = [-1, \"1/100\"] }]\n"
    "effect = [{ kind = \"spring\", between = [\"a\", \"O\"], stiffness = 1, exponent = 3, rest_length = \"9/10\" }]\n";

/// The run goes on and says so.
TEST(RaisingWhereNoNumberIsEnough, IsLogged) {
  Raised<double> raised(cubic, 8, 2, 1.0 / 4);
  raised.run(8);
  EXPECT_EQ(raised.log.unresolved, 1);
  EXPECT_GE(raised.log.first_unresolved, 2);
}

/// Or the step fails at once, for those who divide it.
TEST(RaisingWhereNoNumberIsEnough, FailsIfAskedTo) {
  const Assembled<double> scene = assemble<double>(read_scene(cubic, "cubic"));
  NodeLog log;
  RaisingStepper<double> stepper(scene.problem, HbvmName{8, 2}, SolverKind::fixed_point, log, OnShortage::fail);
  State<double> state(scene.q0, scene.p0);
  expect_words(message_of<StageFailure>([&] {
                 for (int n = 0; n < 8; ++n) stepper.step(state, 1.0 / 4);
               }),
               {"no number of nodes up to 64"});
  EXPECT_EQ(log.unresolved, 0);
}

/// The bead on the helix falls ever faster, and more nodes keep it on the wire.
TYPED_TEST(Raising, OfConstraintNodesKeepsTheConstraints) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("bead_on_helix"));
  const int r = std::same_as<S, double> ? 4 : 8, steps = 112;
  for (const Raises raises : {Raises::k, Raises::k_and_r}) {
    NodeLog log;
    RaisingStepper<S> stepper(scene.problem, HbvmName{3, 3, r}, SolverKind::automatic, log, OnShortage::keep, raises);
    State<S> state(scene.q0, scene.p0);
    GeneralDrift<S> drift(scene.problem);
    drift.start(state.q);
    S greatest = 0;
    for (log.step = 0; log.step < steps; ++log.step) {
      stepper.step(state, S(S(1) / 8));
      raise_to(greatest, drift.in_units(state.q));
    }
    EXPECT_EQ(stepper.k(), 3) << "U is linear";
    EXPECT_EQ(log.unresolved, 0);
    if (raises == Raises::k) {
      EXPECT_EQ(stepper.r(), r);
      EXPECT_GT(greatest, 64);
    } else {
      ASSERT_GT(stepper.r(), r);
      EXPECT_EQ(log.raised.back().r, stepper.r());
      EXPECT_LE(greatest, 64);
    }
  }
}

TEST(RaisingOfAStepThatFails, LeavesTheStateAsItWas) {
  Raised<double> raised(load_scene("kepler"), 4, 2, 20.0);
  EXPECT_THROW(raised.step(), StageFailure);
  EXPECT_EQ(raised.state.q, raised.scene.q0);
  EXPECT_EQ(raised.state.p, raised.scene.p0);
}

}  // namespace
}  // namespace hbvm::core
