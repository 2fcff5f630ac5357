#include "integrate/energy_balance.hpp"

#include "integrate/drift.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

/// An observer made of an EnergyBalance.
template <Scalar S>
struct Balance final : Observer<S> {
  const Problem<S>& problem;
  EnergyBalance<S> energy;
  explicit Balance(const Problem<S>& p) : problem(p), energy(p) {}
  void observe(const Snapshot<S>& snapshot) override {
    Vector<S> v(problem.m());
    problem.mass.velocity(lanes(snapshot.p), lanes(v));
    energy.observe(v, snapshot);
  }
};

TEST(EnergyBalance, ComparesWithTheGreatestTermOfH) {
  for (const char* name : {"charged_double_pendulum", "tethered_satellites", "heavy_top"}) {
    const Scene scene = load_scene(name);
    SceneRun<Quad> run(scene, 2, 2, "1/8", "5");
    Recorder<Quad> recorder;
    Drift<Quad> drift(run.scene.problem);
    Balance<Quad> balance(run.scene.problem);
    run({&recorder, &drift, &balance});
    Quad size = 0;
    for (std::size_t t = 0; t <= scene.effects.size(); ++t) {
      Scene alone = scene;
      alone.effects.clear();
      if (t > 0) alone.effects = {scene.effects[t - 1]};
      const Assembled<Quad> term = assemble<Quad>(alone);
      StateEvaluator<Quad> point(term.problem);
      for (const Snapshot<Quad>& s : recorder.seen)
        raise_to(size, magnitude(point.energy(s.q, t == 0 ? s.p : Vector<Quad>(Vector<Quad>::Zero(s.p.size())))));
    }
    const Quad round_off = 100 * epsilon<Quad>() * size;
    EXPECT_LE(magnitude(Quad(balance.energy.size() - size)), round_off) << name;
    EXPECT_LE(magnitude(Quad(balance.energy.error() - drift.e_H())), round_off) << name;
    EXPECT_GE(balance.energy.rounding(), size) << name;
  }
}

/// 2e5 terms are added up with 2e5 roundings.
TEST(EnergyBalance, CountsTheTermsThatAreAddedUp) {
  Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  const EnergyBalance<double> energy(scene.problem);
  long effects = 0;
  for (const EffectTerm<double>& term : scene.problem.potential.terms) effects += term.instances();
  EXPECT_GT(effects, 1);
  EXPECT_EQ(energy.count(), scene.problem.m() + effects);
}

TEST(EnergyBalance, KnowsWhatRoundingTheCoordinatesChanges) {
  const Scene far_spring = read_scene(
      "dimension = 2\npoint = [{name = \"o\", position = [1000, 0]}]\n"
      "body = [{name = \"b\", mass = 1, position = [1002, 0], velocity = [0, 0]}]\n"
      "effect = [{kind = \"spring\", between = [\"o\", \"b\"], stiffness = 100, rest_length = 1}]\n",
      "far spring");
  const Assembled<double> scene = assemble<double>(far_spring);
  Balance<double> balance(scene.problem);
  balance.observe({0, 0, scene.q0, scene.p0, {}});
  EXPECT_EQ(balance.energy.size(), 50);
  EXPECT_DOUBLE_EQ(balance.energy.rounding(), 1002 * 100);
}

}  // namespace
}  // namespace hbvm::core
