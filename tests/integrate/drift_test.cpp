#include "hbvm/integrate/drift.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "verification/models.hpp"

namespace hbvm {
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
  try {
    drift.observe(snapshot);
    FAIL() << "no error";
  } catch (const IntegrationError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("step 7"), std::string::npos) << what;
    EXPECT_NE(what.find("t = 0.875"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace hbvm
