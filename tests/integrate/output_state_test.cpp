#include "integrate/output_state.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

class OutputStates : public InDigits<50> {
 protected:
  const Mpfr tolerance = 10'000 * epsilon<Mpfr>();
};

TEST_F(OutputStates, AreTheClosedFormulas) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    SceneRun<Mpfr> run(read_scene(model.scene, "model"), 2, 2, "1/10", "1/2");
    const Integration<Mpfr> result = run({});
    StateEvaluator<Mpfr> point(run.scene.problem);
    const auto& [q, p] = std::tie(result.end.q, result.end.p);
    const OutputState<Mpfr> output = output_state(point, q, p);
    EXPECT_GT(max_norm(model.hidden(q, p)), literal<Mpfr>("1e-8")) << "p should leave the tangent space visibly";
    EXPECT_LE(max_norm(model.hidden(q, output.p)), tolerance);
    const Vector<Mpfr> expected_p = model.tangential(q, p);
    EXPECT_LE(max_norm(Vector<Mpfr>(output.p - expected_p)), tolerance);
    EXPECT_LE(max_norm(Vector<Mpfr>(output.lambda - model.multiplier(q, expected_p))), tolerance);
  }
}

TEST_F(OutputStates, LeaveATangentialMomentumAlone) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    StateEvaluator<Mpfr> point(scene.problem);
    const OutputState<Mpfr> output = output_state(point, scene.q0, scene.p0);
    EXPECT_LE(max_norm(Vector<Mpfr>(output.p - scene.p0)), tolerance);
  }
}

TEST_F(OutputStates, EnergyDiffersByTheSquareOfTheHiddenConstraint) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    SceneRun<Mpfr> run(read_scene(model.scene, "model"), 1, 1, "1/10", "1/2");
    const Integration<Mpfr> result = run({});
    StateEvaluator<Mpfr> point(run.scene.problem);
    const auto& [q, p] = std::tie(result.end.q, result.end.p);
    const OutputState<Mpfr> output = output_state(point, q, p);
    const Vector<Mpfr> w = model.hidden(q, p);
    const Mpfr expected = -w.dot(model.gram_solve(q, w)) / 2;
    EXPECT_LT(expected, literal<Mpfr>("-1e-9"));
    const Mpfr difference = point.energy(q, output.p) - point.energy(q, p);
    EXPECT_LE(magnitude(Mpfr(difference - expected)), tolerance);
  }
}

TEST_F(OutputStates, WithoutConstraintsAreTheStateItself) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(
      read_scene("dimension = 2\n[[body]]\nname = \"a\"\nmass = 2\nposition = [0, 0]\nvelocity = [0.1, 0]\n", "free"));
  StateEvaluator<Mpfr> point(scene.problem);
  const OutputState<Mpfr> output = output_state(point, scene.q0, scene.p0);
  EXPECT_EQ(output.p, scene.p0);
  EXPECT_EQ(output.lambda.size(), 0);
}

}  // namespace
}  // namespace hbvm::core
