#include "integrate/drift.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "solver/error_of.hpp"
#include "verification/models.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Drift, IsTheMaximumOverTheMesh) {
  const PrecisionScope digits(50);
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    SceneRun<Mpfr> run(read_scene(model.scene, "model"), 2, 2, "1/10", "2");
    Drift<Mpfr> drift(run.scene.problem);
    Recorder<Mpfr> recorder;
    run({&drift, &recorder});
    const Mpfr H0 = model.energy(run.scene.q0, run.scene.p0);
    Mpfr e_H = 0, e_g = 0, e_hid = 0;
    for (const Snapshot<Mpfr>& s : recorder.seen) {
      raise_to(e_H, magnitude(Mpfr(model.energy(s.q, s.p) - H0)));
      raise_to(e_g, max_norm(model.g(s.q)));
      raise_to(e_hid, max_norm(model.hidden(s.q, s.p)));
    }
    const Mpfr tolerance = 1'000 * epsilon<Mpfr>();
    EXPECT_LE(magnitude(Mpfr(drift.H0() - H0)), tolerance);
    EXPECT_LE(magnitude(Mpfr(drift.e_H() - e_H)), tolerance);
    EXPECT_LE(magnitude(Mpfr(drift.e_g() - e_g)), tolerance);
    EXPECT_LE(magnitude(Mpfr(drift.e_hid() - e_hid)), tolerance);
    EXPECT_GT(drift.e_hid(), literal<Mpfr>("1e-8")) << "the hidden constraint should drift visibly";
    EXPECT_LE(drift.e_g(), tolerance);
  }
}

TEST(Drift, IncludesTheStart) {
  const Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  Drift<double> drift(scene.problem);
  Snapshot<double> snapshot{0, 0, scene.q0, scene.p0, Vector<double>::Zero(1)};
  snapshot.q[1] = -2;
  snapshot.p[1] = 0.5;
  drift.observe(snapshot);
  EXPECT_EQ(drift.e_H(), 0);
  EXPECT_EQ(drift.e_g(), 3);
  EXPECT_EQ(drift.e_hid(), 2);
  EXPECT_EQ(drift.H0(), 0.5 + 0.125 - 2);
}

TEST(Drift, KeepsTheLargest) {
  const Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  Drift<double> drift(scene.problem);
  const auto show = [&](long n, double p) {
    Snapshot<double> snapshot{n, 0, scene.q0, scene.p0, Vector<double>::Zero(1)};
    snapshot.p[0] = p;
    drift.observe(snapshot);
  };
  show(0, 1);
  show(1, 3);
  show(2, 2);
  show(3, 0);
  EXPECT_EQ(drift.e_H(), 4);
}

TEST(Drift, WithoutConstraintsIsOfTheEnergyAlone) {
  SceneRun<double> run(
      read_scene("dimension = 2\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n", "free"), 1,
      1, "1", "3");
  Drift<double> drift(run.scene.problem);
  run({&drift});
  EXPECT_EQ(drift.H0(), 0.5);
  EXPECT_EQ(drift.e_H(), 0);
  EXPECT_EQ(drift.e_g(), 0);
  EXPECT_EQ(drift.e_hid(), 0);
}

TEST(Drift, RefusesAStateWithoutEnergy) {
  const Assembled<double> scene = assemble<double>(load_scene("modified_pendulum"));
  Drift<double> drift(scene.problem);
  Snapshot<double> snapshot{7, 0.875, scene.q0, scene.p0, Vector<double>::Zero(1)};
  drift.observe({0, 0, scene.q0, scene.p0, snapshot.lambda});
  snapshot.q << 2, 0;  // on the fixed charge
  expect_words(message_of<IntegrationError>([&] { drift.observe(snapshot); }), {"step 7", "t = 0.875"});
}

/// A pendulum and, set aside, the wall x = 0, which it should not leave.
TEST(Drift, WatchesRedundantConstraints) {
  Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  Vector<double> normal = Vector<double>::Zero(2);
  normal[0] = 1;
  scene.problem.redundant.push_back({1, {"wall", Plane<double>{{0}, normal, 0}}});
  Drift<double> drift(scene.problem);
  Snapshot<double> snapshot{3, 0.5, scene.q0, scene.p0, Vector<double>::Zero(1)};
  snapshot.q << 0, -1;
  snapshot.p << 4, 0;
  drift.observe(snapshot);
  EXPECT_EQ(drift.e_hid(), 4);
  EXPECT_EQ(drift.e_g(), 0);
  EXPECT_EQ(drift.redundancy(), 0);
  snapshot.q[0] = 1e-3;
  const auto error = error_of<RedundancyLost>([&] { drift.observe(snapshot); });
  EXPECT_EQ(error.cause(), FailureCause::inconsistent_state);
  EXPECT_EQ(error.constraint(), "wall");
  EXPECT_EQ(error.time(), "0.5");
  expect_words(error.what(), {"step 3", "t = 0.5", "constraint 2 (wall)", "1.00e-03", "inconsistent_state"});
  EXPECT_EQ(drift.e_g(), 1e-3);
  EXPECT_EQ(drift.redundancy(), 1);
}

/// Below the root of epsilon of its terms a violation is told, but does not end the run.
TEST(Drift, ToleratesSmallViolationsOfRedundantConstraints) {
  Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  Vector<double> normal = Vector<double>::Ones(2);
  scene.problem.redundant.push_back({0, {"wall", Plane<double>{{0}, normal, -1}}});
  Drift<double> drift(scene.problem);
  Snapshot<double> snapshot{0, 0, scene.q0, scene.p0, Vector<double>::Zero(1)};
  snapshot.q << 0, -1 + 0x1p-27;  // terms of 2
  drift.observe(snapshot);
  EXPECT_NEAR(drift.redundancy() / 0x1p-28, 1, 1e-6);
  snapshot.q << 0, -1 + 0x1p-24;
  EXPECT_THROW(drift.observe(snapshot), RedundancyLost);
}

/// A rod twice is one rod with half the multiplier each, and the motion is the same to the last bit.
TEST(Drift, OfADoubledRodIsThatOfARod) {
  Scene once = load_scene("double_pendulum"), twice = once;
  twice.constraints.push_back(twice.constraints[0]);
  SceneRun<double> one(once, 3, 2, "1/16", "4"), two(twice, 3, 2, "1/16", "4");
  Drift<double> drift(one.scene.problem), same(two.scene.problem);
  const auto end = one({&drift}).end, also = two({&same}).end;
  EXPECT_EQ(also.q, end.q);
  EXPECT_EQ(also.p, end.p);
  EXPECT_EQ(same.e_H(), drift.e_H());
  EXPECT_EQ(same.e_g(), drift.e_g());
  const Vector<double> all = RedundantConstraints<double>(two.scene.problem).multipliers(also.q, also.lambda);
  ASSERT_EQ(all.size(), 3);
  EXPECT_NEAR(all[0], end.lambda[0] / 2, 1e-14);
  EXPECT_NEAR(all[2], end.lambda[0] / 2, 1e-14);
  EXPECT_NEAR(all[1], end.lambda[1], 1e-14);
}

}  // namespace
}  // namespace hbvm::core
