#include "step/constraint_projection.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"
#include "solver/error_of.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ConstraintProjectionTest : public InDigits<50> {
 protected:
  RandomValues<S> random{53};
  const S tolerance = 10'000 * epsilon<S>();

  static Vector<S> inverse_mass_times(const Problem<S>& problem, const Vector<S>& p) {
    return times(dense_inverse(dense_mass(problem.mass)), p);
  }
};
TYPED_TEST_SUITE(ConstraintProjectionTest, AllScalars, ScalarNames);

constexpr const char* constrained_scenes[] = {"double_pendulum", "tethered_satellites", "heavy_top",
                                              "bead_on_ellipsoid"};

TYPED_TEST(ConstraintProjectionTest, PositionsLieOnTheConstraintsInTheDirectionsOfTheStart) {
  using S = TypeParam;
  for (const char* const name : constrained_scenes) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const Problem<S>& problem = scene.problem;
    ConstraintProjection<S> projection(problem);
    projection.set_directions(scene.q0);
    Vector<S> free = scene.q0 + this->random.vector(problem.m()) / S(64), q = free;
    const S factor = S(-1) / 16;
    Matrix<S> lambda = Matrix<S>::Zero(1, problem.nu());
    EXPECT_LE(projection.find_position(free, factor, lambda, q), 40) << name;
    EXPECT_LE(max_norm(dense_constraints(problem, q)), this->tolerance) << name;
    const Vector<S> pull = times(dense_gradient(problem, scene.q0), Vector<S>(lambda.row(0).transpose()));
    EXPECT_LE(max_norm(Vector<S>(q - free - factor * this->inverse_mass_times(problem, pull))), this->tolerance)
        << name;
    EXPECT_GT(max_norm(lambda), 0) << name;
    // The multipliers found are a start from which nothing is left to do.
    Matrix<S> again = lambda;
    EXPECT_LE(projection.find_position(free, factor, again, q), 3) << name;
    EXPECT_LE(max_norm(Matrix<S>(again - lambda)), this->tolerance * max_norm(lambda)) << name;
  }
}

TYPED_TEST(ConstraintProjectionTest, MomentaBecomeTangentialThere) {
  using S = TypeParam;
  for (const char* const name : constrained_scenes) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const Problem<S>& problem = scene.problem;
    ConstraintProjection<S> projection(problem);
    projection.set_position(scene.q0);
    const Vector<S> before = scene.p0 + this->random.vector(problem.m());
    Vector<S> p = before;
    const Matrix<S> mu = projection.make_tangential(p);
    const Matrix<S> G = dense_gradient(problem, scene.q0);
    EXPECT_LE(max_norm(times(Matrix<S>(G.transpose()), this->inverse_mass_times(problem, p))), this->tolerance) << name;
    EXPECT_LE(max_norm(Vector<S>(before - p - times(G, Vector<S>(mu.row(0).transpose())))), this->tolerance) << name;
    StateEvaluator<S> point(problem);
    EXPECT_LE(max_norm(Vector<S>(p - point.tangential(scene.q0, before))), this->tolerance) << name;
  }
}

/// The position found last gives the directions of the next step.
TYPED_TEST(ConstraintProjectionTest, AdvancesToThePositionFound) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  ConstraintProjection<S> projection(scene.problem), anew(scene.problem);
  projection.set_directions(scene.q0);
  Vector<S> free = scene.q0 + this->random.vector(scene.problem.m()) / S(64), q = free;
  Matrix<S> lambda = Matrix<S>::Zero(1, scene.problem.nu()), other = lambda;
  projection.find_position(free, S(1), lambda, q);
  projection.advance();
  anew.set_directions(q);
  free = q + this->random.vector(scene.problem.m()) / S(64);
  Vector<S> there = free, expected = free;
  lambda = other;
  projection.find_position(free, S(1), lambda, there);
  anew.find_position(free, S(1), other, expected);
  EXPECT_EQ(there, expected);
  EXPECT_EQ(lambda, other);
}

TYPED_TEST(ConstraintProjectionTest, DependentGradientsAreATypedFailure) {
  using S = TypeParam;
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = problem.potential.m = 2;
  problem.mass.add_scalar(2, S(1));
  for (int n = 0; n < 2; ++n) problem.constraints.push_back({"plane", Plane<S>{{0}, Vector<S>::Unit(2, 0), S(1)}});
  ConstraintProjection<S> projection(problem);
  Vector<S> q = Vector<S>::Constant(2, S(2)), p = q;
  projection.set_position(q);
  EXPECT_EQ(error_of<StageFailure>([&] { projection.make_tangential(p); }).cause(),
            FailureCause::near_singular_constraints);
  projection.set_directions(q);
  Matrix<S> lambda = Matrix<S>::Zero(1, 2);
  EXPECT_THROW(projection.find_position(Vector<S>(q), S(1), lambda, q), StageFailure);
}

}  // namespace
}  // namespace hbvm::core
