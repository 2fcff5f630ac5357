#include "hbvm/integrate/raising_stepper.hpp"

#include "hbvm/integrate/drift.hpp"
#include "hbvm/integrate/energy_scale.hpp"
#include "hbvm/scene/assemble.hpp"
#include "printing.hpp"

namespace hbvm {
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

  Raised(const std::string& toml, int k, int s, const S& step, SolverKind kind = SolverKind::fixed_point)
      : Raised(read_scene(toml, "test"), k, s, step, kind) {}
  Raised(const Scene& text, int k, int s, const S& step, SolverKind kind = SolverKind::fixed_point)
      : scene(assemble<S>(text)),
        stepper(scene.problem, k, s, step, kind, log),
        state(scene.q0, scene.p0),
        drift(scene.problem),
        scale(scene.problem) {}

  void run(long steps) {
    Snapshot<S> snapshot{0, S(0), state.q, state.p, {}};
    for (; snapshot.n <= steps; ++snapshot.n) {
      drift.observe(snapshot);
      scale.observe(snapshot);
      if (snapshot.n == steps) break;
      log.step = snapshot.n;
      stepper.step(state);
      snapshot.q = state.q;
      snapshot.p = state.p;
    }
  }
  bool conserved(long steps) const { return drift.e_H() <= scale.round_off(steps); }
};

template <class S>
class Raising : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
};
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
    const Hbvm<S> method = make_hbvm<S>(k, 2);
    HbvmStepper<S> plain(raised.scene.problem, method, h, kind);
    State<S> state(raised.scene.q0, raised.scene.p0);
    for (int n = 0; n < 40; ++n) plain.step(state);
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

  const Hbvm<S> method = make_hbvm<S>(k, 2);
  HbvmStepper<S> plain(raised.scene.problem, method, S(S(1) / 32), SolverKind::fixed_point);
  State<S> state(raised.scene.q0, raised.scene.p0);
  Drift<S> drift(raised.scene.problem);
  for (long n = 0; n <= steps; ++n) {
    drift.observe({n, S(n), state.q, state.p, {}});
    plain.step(state);
  }
  EXPECT_GT(drift.e_H(), 1'000 * raised.scale.round_off(steps)) << "the plain method should fail";
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

/// Across r = 9/10, where |r - 9/10|^3 is not smooth, no number of nodes is enough: the run goes on and says so.
TEST(RaisingWhereNoNumberIsEnough, IsLogged) {
  const std::string cubic =
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 1, position = [2, 0], velocity = [-1, \"1/100\"] }]\n"
      "effect = [{ kind = \"spring\", between = [\"a\", \"O\"], stiffness = 1, exponent = 3, rest_length = \"9/10\" "
      "}]\n";
  Raised<double> raised(cubic, 8, 2, 1.0 / 4);
  raised.run(8);
  EXPECT_EQ(raised.log.unresolved, 1);
  EXPECT_GE(raised.log.first_unresolved, 2);
}

TEST(RaisingOfAStepThatFails, LeavesTheStateAsItWas) {
  Raised<double> raised(load_scene("kepler"), 4, 2, 20.0);
  EXPECT_THROW(raised.stepper.step(raised.state), StageFailure);
  EXPECT_EQ(raised.state.q, raised.scene.q0);
  EXPECT_EQ(raised.state.p, raised.scene.p0);
}

}  // namespace
}  // namespace hbvm
