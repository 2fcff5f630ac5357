#include "run/scene_run.hpp"

#include "linear/vector_text.hpp"
#include "printing.hpp"
#include "runs/request_of.hpp"
#include "scene/assemble.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

class RunTest : public InDigits<50> {
 protected:
  const Mpfr tolerance = 10'000 * epsilon<Mpfr>();

  static hbvm::Run result(const DenseModel& model, const char* method, SolverKind solver) {
    return run(request_of(read_scene(model.scene, "model"), method, "1/10", "1/2", "mpfr:50", solver), {});
  }
};

/// Its momentum is tangential, and its multiplier belongs to that momentum, not to the propagated one.
TEST_F(RunTest, OutputStateIsTheClosedFormulas) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const hbvm::Run found = result(model, "hbvm:2,2", SolverKind::fixed_point);
    const Vector<Mpfr> q = vector_of<Mpfr>(found.q), p = vector_of<Mpfr>(found.p), output_p = model.tangential(q, p),
                       output_lambda = model.multiplier(q, output_p);
    EXPECT_GT(distance(output_p, p), literal<Mpfr>("1e-9")) << "the two states should differ visibly";
    EXPECT_GT(distance(output_lambda, Vector<Mpfr>(model.multiplier(q, p))), literal<Mpfr>("1e-9"));
    EXPECT_LE(distance(vector_of<Mpfr>(found.output_p), output_p), tolerance);
    EXPECT_LE(distance(vector_of<Mpfr>(found.output_lambda), output_lambda), tolerance);
    const Assembled<Mpfr> start = assemble<Mpfr>(read_scene(model.scene, "model"));
    const Mpfr delta_H = model.energy(q, output_p) - model.energy(start.q0, start.p0);
    EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(found.output_delta_H) - delta_H)), tolerance);
  }
}

/// Every solver leads to the same end, and is the one that is asked for: they take unlike numbers of sweeps.
TEST_F(RunTest, UsesTheSolverThatIsAskedFor) {
  const DenseModel model = ellipsoid_bead();
  const hbvm::Run fixed_point = result(model, "hbvm:3,2", SolverKind::fixed_point),
                  newton = result(model, "hbvm:3,2", SolverKind::newton),
                  papers = result(model, "hbvm:3,2", SolverKind::paper);
  EXPECT_LT(newton.iterations_per_step, fixed_point.iterations_per_step);
  EXPECT_LT(fixed_point.iterations_per_step, papers.iterations_per_step);
  for (const hbvm::Run* other : {&newton, &papers}) {
    EXPECT_LE(distance(vector_of<Mpfr>(other->q), vector_of<Mpfr>(fixed_point.q)), tolerance);
    EXPECT_LE(distance(vector_of<Mpfr>(other->p), vector_of<Mpfr>(fixed_point.p)), tolerance);
  }
}

}  // namespace
}  // namespace hbvm::core
