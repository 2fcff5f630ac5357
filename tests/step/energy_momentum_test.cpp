#include "step/energy_momentum.hpp"

#include "printing.hpp"
#include "problem/momenta.hpp"
#include "problem/state_evaluator.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <class S>
class EnergyMomentumTest : public InDigits<50> {};
TYPED_TEST_SUITE(EnergyMomentumTest, AllScalars, ScalarNames);

/// Whatever U is, and with steps as long as they can be.
TYPED_TEST(EnergyMomentumTest, KeepsEnergyMomentaAndConstraints) {
  using S = TypeParam;
  for (const char* const name : {"tethered_satellites", "modified_pendulum", "charged_tetrahedron", "heavy_top",
                                 "kepler", "bead_on_ellipsoid", "quartic_oscillator"}) {
    SceneSteps<S> steps(load_scene(name), "energy_momentum");
    const Problem<S>& problem = steps.scene.problem;
    const State<S>& state = steps.state;
    StateEvaluator<S> point(problem);
    const S H0 = point.energy(state.q, state.p), size = point.energy_size(state.q, state.p);
    const auto momenta = conserved_momenta(problem);
    std::vector<MomentumValue<S>> first;
    for (const auto& component : momenta) first.push_back(momentum(problem, component, state.q, state.p));
    for (int n = 0; n < 100; ++n) steps.step(S(1) / 16);
    EXPECT_LE(magnitude(S(point.energy(state.q, state.p) - H0)), 2'000 * size * epsilon<S>()) << name;
    for (std::size_t c = 0; c < momenta.size(); ++c) {
      const auto now = momentum(problem, momenta[c], state.q, state.p);
      EXPECT_LE(magnitude(S(now.value - first[c].value)), 2'000 * (1 + now.size) * epsilon<S>()) << name;
    }
    if (problem.nu() > 0) {
      EXPECT_LE(max_norm(point.constraints(state.q)), 32 * epsilon<S>() * point.constraint_size(state.q)) << name;
    }
  }
}

/// Order 2 in q and p, and 1 in the multiplier, which is that of the middle.
TEST(EnergyMomentum, HasItsOrders) {
  const PrecisionScope digits(50);
  for (const char* const name : {"modified_pendulum", "double_pendulum", "kepler"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    StateEvaluator<Mpfr> point(scene.problem);
    const State<Mpfr> exact = after("hbvm:10,10", scene, Mpfr(1) / 32, 16);
    const Vector<Mpfr> p = point.tangential(exact.q, exact.p), lambda = point.multiplier(exact.q, p);
    const auto end = [&](long steps) { return end_of("energy_momentum", scene, Mpfr(1) / (2 * steps), steps); };
    const auto rate = [&](const auto& error) { return order_of<Mpfr>(error(end(128)), error(end(256))); };
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.first.q, exact.q); }), 2, 0.1) << name;
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.first.p, p); }), 2, 0.1) << name;
    if (scene.problem.nu() == 0) continue;
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.second, lambda); }), 1, 0.1) << name;
  }
}

/// With a potential of degree 2 at most, whose discrete gradient is that of the mean, it is HBVM(1,1).
TYPED_TEST(EnergyMomentumTest, IsTheMidpointRuleOfAPotentialOfDegreeTwo) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "heavy_top"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const State<S> own = after("energy_momentum", scene, S(1) / 64, 20),
                   other = after("hbvm:1,1", scene, S(1) / 64, 20, SolverKind::automatic);
    EXPECT_LE(distance(own.q, other.q), 10'000 * epsilon<S>()) << name;
    EXPECT_LE(distance(own.p, other.p), 100'000 * epsilon<S>()) << name;
  }
}

/// A body a million times as heavy, and one as far away, in the units of mice.
TYPED_TEST(EnergyMomentumTest, HoldsForUnevenMassesAndLengths) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(read_scene(
      "dimension = 3\n"
      "body = [{ name = \"heavy\", mass = 1000000, position = [0, 0, 0], velocity = [0, \"1/1000000\", 0] },\n"
      "        { name = \"light\", mass = \"1/1000\", position = [1, 0, 0], velocity = [0, \"1/7\", \"1/3\"] },\n"
      "        { name = \"far\", mass = 1, position = [1000, 10, 0], velocity = [1, 0, \"1/9\"] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"heavy\", \"light\"], length = 1 }]\n"
      "effect = [{ kind = \"mutual_gravity\", strength = \"1/1000\", between = [\"heavy\", \"light\"] },\n"
      "          { kind = \"mutual_gravity\", strength = \"1/1000\", between = [\"heavy\", \"far\"] },\n"
      "          { kind = \"mutual_gravity\", strength = \"1/1000\", between = [\"light\", \"far\"] }]\n",
      "uneven"));
  StateEvaluator<S> point(scene.problem);
  const S H0 = point.energy(scene.q0, scene.p0), size = point.energy_size(scene.q0, scene.p0);
  const State<S> end = after("energy_momentum", scene, S(1) / 128, 50);
  EXPECT_LE(magnitude(S(point.energy(end.q, end.p) - H0)), 10'000 * size * epsilon<S>());
}

TEST(EnergyMomentum, CountsWhatItDid) {
  SceneSteps<double> satellites(load_scene("tethered_satellites"), "energy_momentum");
  long sweeps = 0;
  for (int n = 0; n < 10; ++n) sweeps += satellites.step(0.05).sweeps;
  const SolverCounts counts = satellites.stepper->counts();
  EXPECT_EQ(static_cast<long>(counts.effects[0].evaluations), sweeps);
  EXPECT_EQ(calls_of(counts, "midpoint and momenta"), sweeps);
  EXPECT_EQ(calls_of(counts, "multipliers"), sweeps);
}

}  // namespace
}  // namespace hbvm::core
