#include "problem/force_slopes.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "problem/work_scene.hpp"

namespace hbvm::core {
namespace {

class ForceSlopesTest : public InDigits<60> {};

TEST_F(ForceSlopesTest, AreDifferencesOfForces) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  const Problem<Mpfr>& problem = scene.problem;
  const Index bodies = problem.clock();
  const Vector<Mpfr> q = placed_at(problem, scene.q0, Mpfr(Mpfr(2) / 7));
  Vector<Mpfr> v(problem.m());
  StateEvaluator<Mpfr>(problem).set_velocity(q, scene.p0, v);
  ForceSlopes<Mpfr> slopes(problem, 1);
  slopes.evaluate(lanes(q), lanes(std::as_const(v)));
  Matrix<Mpfr> by_position = Matrix<Mpfr>::Zero(bodies, bodies), by_velocity = by_position;
  for (std::size_t n = 0; n < slopes.pairs().size(); ++n) {
    const auto [row, column] = slopes.pairs()[n];
    by_position(row, column) = slopes.by_position()(0, static_cast<Index>(n));
    by_velocity(row, column) = slopes.by_velocity()(0, static_cast<Index>(n));
  }
  ForceEvaluator<Mpfr> forces(problem, 1);
  DrivenCourse<Mpfr> course(problem, 1);
  place(course, problem, q);
  const auto force = [&](const Vector<Mpfr>& at, const Vector<Mpfr>& rate) {
    Matrix<Mpfr> result = Matrix<Mpfr>::Zero(1, problem.m());
    forces.add(lanes(at), lanes(rate), course, result);
    return Vector<Mpfr>(result.row(0).head(bodies).transpose());
  };
  const Mpfr step = literal<Mpfr>("1e-20"), small = literal<Mpfr>("1e-30");
  for (Index j = 0; j < bodies; ++j) {
    const Vector<Mpfr> off = step * Vector<Mpfr>::Unit(problem.m(), j);
    const Vector<Mpfr> of_q = (force(q + off, v) - force(q - off, v)) / (2 * step),
                       of_v = (force(q, v + off) - force(q, v - off)) / (2 * step);
    for (Index i = 0; i < bodies; ++i) {
      EXPECT_LE(magnitude(Mpfr(of_q[i] - by_position(i, j))), small) << i << ',' << j;
      EXPECT_LE(magnitude(Mpfr(of_v[i] - by_velocity(i, j))), small) << i << ',' << j;
    }
  }
}

/// The derivative of |v| v at rest is left out of what leads an iteration.
TEST_F(ForceSlopesTest, AreFiniteAtRest) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  ForceSlopes<Mpfr> slopes(scene.problem, 1);
  slopes.evaluate(lanes(scene.q0), lanes(Vector<Mpfr>(Vector<Mpfr>::Zero(scene.problem.m()))));
  for (Index i = 0; i < slopes.by_velocity().size(); ++i) EXPECT_TRUE(is_finite(slopes.by_velocity().data()[i]));
}

}  // namespace
}  // namespace hbvm::core
