#include "verification/second_route.hpp"

#include "integrate/drift.hpp"
#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

/// HBVM of high order against an integration by other variables and another method.
class SecondRoute : public InDigits<40> {
 protected:
  static constexpr int k = 10, s = 8;
  const Mpfr T = Mpfr(1) / 2, thirty_digits = literal<Mpfr>("1e-30");

  Exact by_hbvm(const Scene& scene, const char* step) {
    SceneRun<Mpfr> run(scene, k, s, step, "1/2");
    Drift<Mpfr> drift(run.scene.problem);
    const Integration<Mpfr> result = run({&drift});
    EXPECT_LE(drift.e_g(), 1'000 * epsilon<Mpfr>());
    StateEvaluator<Mpfr> point(run.scene.problem);
    const OutputState<Mpfr> output = output_state(point, result.end.q, result.end.p);
    return {result.end.q, output.p, output.lambda};
  }

  void expect_agreement(const Exact& a, const Exact& b) const {
    EXPECT_LE(distance(a.q, b.q), thirty_digits);
    EXPECT_LE(distance(a.p, b.p), thirty_digits);
    EXPECT_LE(distance(a.lambda, b.lambda), thirty_digits);
  }
};

TEST_F(SecondRoute, DoublePendulumOfUnequalMasses) {
  expect_agreement(by_hbvm(load_scene(scene_path("double_pendulum")), "1/256"), DoublePendulumInAngles().at(T, 8'000));
}

TEST_F(SecondRoute, SphericalPendulumBesideACharge) {
  expect_agreement(by_hbvm(load_scene(scene_path("spherical_pendulum")), "1/128"),
                   SphericalPendulumInAngles().at(T, 4'000));
}

TEST_F(SecondRoute, BeadOfMatrixMassOnAnEllipsoidAndOnACurve) {
  for (const DenseModel& model : {ellipsoid_bead(), bead_on_curve()}) {
    const Scene scene = read_scene(model.scene, "bead");
    const Assembled<Mpfr> start = assemble<Mpfr>(scene);
    expect_agreement(by_hbvm(scene, "1/128"), IndexReduced{model}.at(start.q0, start.p0, T, 4'000));
  }
}

}  // namespace
}  // namespace hbvm::core
