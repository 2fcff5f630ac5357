#include "problem/force_evaluator.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "problem/work_scene.hpp"

namespace hbvm::core {
namespace {

class ForceEvaluatorTest : public InDigits<40> {};

/// T' - U' and what the accounts take add up to 0: v.p' - grad U.q' + sum p_X' where q' has the driven velocities.
TEST_F(ForceEvaluatorTest, AccountsTakeWhatForcesDo) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  const Problem<Mpfr>& problem = scene.problem;
  const Vector<Mpfr> q = placed_at(problem, scene.q0, Mpfr(Mpfr(2) / 7));
  StateEvaluator<Mpfr> point(problem);
  Vector<Mpfr> v(problem.m());
  point.set_velocity(q, scene.p0, v);
  Matrix<Mpfr> gradient, force;
  PotentialEvaluator<Mpfr>(problem.potential, 1).force(lanes(q), gradient);
  point.set_applied(q, scene.p0, force);
  Mpfr power = 0, size = 0;
  for (Index j = 0; j < problem.m(); ++j) {
    power -= gradient(0, j) * v[j];
    power += j < problem.clock() ? Mpfr(v[j] * force(0, j)) : force(0, j);
    size += magnitude(Mpfr(v[j] * force(0, j)));
  }
  EXPECT_GT(size, 1);
  EXPECT_LE(magnitude(power), 64 * size * epsilon<Mpfr>());
}

/// All lanes at once are the lanes one by one.
TEST_F(ForceEvaluatorTest, LanesDoNotMix) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  const Problem<Mpfr>& problem = scene.problem;
  constexpr Index lanes_at_once = 3;
  ForceEvaluator<Mpfr> all(problem, lanes_at_once), one(problem, 1);
  DrivenCourse<Mpfr> course(problem, lanes_at_once), course_of_one(problem, 1);
  Matrix<Mpfr> q(lanes_at_once, problem.m()), v(q), force = Matrix<Mpfr>::Zero(lanes_at_once, problem.m());
  for (Index i = 0; i < lanes_at_once; ++i) {
    course.time(i) = Mpfr(i) / 3;
    for (Index j = 0; j < problem.m(); ++j) {
      q(i, j) = scene.q0[j] + Mpfr(i * j) / 5;
      v(i, j) = Mpfr(1 + i + j) / 4;
    }
  }
  course.evaluate();
  course.set_positions(lanes(q));
  course.set_velocities(lanes(v));
  all.add(lanes(std::as_const(q)), lanes(std::as_const(v)), course, force);
  for (Index i = 0; i < lanes_at_once; ++i) {
    const Vector<Mpfr> q_i = q.row(i).transpose(), v_i = v.row(i).transpose();
    Matrix<Mpfr> alone = Matrix<Mpfr>::Zero(1, problem.m());
    place(course_of_one, problem, q_i);
    one.add(lanes(q_i), lanes(v_i), course_of_one, alone);
    EXPECT_EQ(Vector<Mpfr>(alone.row(0).transpose()), Vector<Mpfr>(force.row(i).transpose()));
  }
  EXPECT_EQ(all.counts().front().evaluations, 3U);
}

}  // namespace
}  // namespace hbvm::core
