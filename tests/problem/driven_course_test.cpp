#include "problem/driven_course.hpp"

#include "printing.hpp"
#include "problem/work_scene.hpp"

namespace hbvm::core {
namespace {

class DrivenCourseTest : public InDigits<40> {};

TEST_F(DrivenCourseTest, SetsPositionsVelocitiesAccelerations) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  const Problem<Mpfr>& problem = scene.problem;
  DrivenCourse<Mpfr> course(problem, 2);
  course.time(0) = Mpfr(1) / 3;
  course.time(1) = Mpfr(2);
  course.evaluate();
  Matrix<Mpfr> q = Matrix<Mpfr>::Zero(2, problem.m()), v = q, a = q,
               force = Matrix<Mpfr>::Constant(2, problem.m(), Mpfr(5));
  course.set_positions(lanes(q));
  course.set_velocities(lanes(v));
  course.set_accelerations(lanes(a));
  course.make_powers(lanes(force));
  // t, then the hand.
  const Index clock = problem.clock(), hand = clock + 2;
  for (Index i = 0; i < 2; ++i) {
    const Mpfr t = i == 0 ? Mpfr(Mpfr(1) / 3) : Mpfr(2);
    EXPECT_EQ(q(i, clock), t);
    EXPECT_EQ(v(i, clock), 1);
    EXPECT_EQ(v(i, clock + 1), 0);
    EXPECT_LE(magnitude(Mpfr(q(i, hand) - sin(Mpfr(3 * t)))), 4 * epsilon<Mpfr>());
    EXPECT_LE(magnitude(Mpfr(v(i, hand) - 3 * cos(Mpfr(3 * t)))), 16 * epsilon<Mpfr>());
    EXPECT_LE(magnitude(Mpfr(a(i, hand) + 9 * sin(Mpfr(3 * t)))), 64 * epsilon<Mpfr>());
    EXPECT_EQ(force(i, hand + 1), 5 * v(i, hand + 1));
    EXPECT_EQ(force(i, 0), 5);
  }
  EXPECT_EQ(q(0, 0), 0) << "bodies are left alone";
}

}  // namespace
}  // namespace hbvm::core
