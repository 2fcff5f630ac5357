#include "problem/discrete_force.hpp"

#include "clock.hpp"
#include "linear/product.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

template <class S>
class DiscreteForces : public InDigits<40> {};
TYPED_TEST_SUITE(DiscreteForces, AllScalars, ScalarNames);

/// Springs and charges at points of rigid bodies, pairs, fields and several effects together.
TYPED_TEST(DiscreteForces, TimesTheMotionAreTheDifferenceOfU) {
  using S = TypeParam;
  RandomValues<S> random(31);
  for (const char* const name : {"tethered_satellites", "charged_tetrahedron", "heavy_top", "modified_pendulum",
                                 "charged_double_pendulum", "kepler", "double_pendulum"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const Potential<S>& potential = scene.problem.potential;
    DiscreteForce<S> force(potential);
    PotentialEvaluator<S> evaluator(potential, 1);
    const Vector<S> q0 = scene.q0, q1 = scene.q0 + random.vector(scene.problem.m()) / 16;
    Matrix<S> D = Matrix<S>::Zero(1, scene.problem.m()), gradient;
    force.evaluate(q0, q1, D);
    Vector<S> U0, U1;
    evaluator.values(lanes(q0), U0);
    evaluator.values(lanes(q1), U1);
    const Vector<S> row = D.transpose();
    const S size = magnitude(U0[0]) + magnitude(U1[0]) + max_norm(row) * (1 + max_norm(q0));
    EXPECT_LE(magnitude(S(dot(row, Vector<S>(q1 - q0)) - (U1[0] - U0[0]))), 256 * size * epsilon<S>()) << name;
    force.evaluate(q0, q0, D);
    evaluator.force(lanes(q0), gradient);
    EXPECT_LE(max_norm(Matrix<S>(D - gradient)), 256 * max_norm(gradient) * epsilon<S>()) << name;
  }
}

TEST(DiscreteForce, CountsWhatItEvaluates) {
  const Assembled<double> scene = assemble<double>(load_scene("modified_pendulum"));
  const Potential<double>& potential = scene.problem.potential;
  DiscreteForce<double> force(potential);
  const MeasuredParts measured;
  Matrix<double> D = Matrix<double>::Zero(1, scene.problem.m());
  for (int n = 0; n < 3; ++n) force.evaluate(scene.q0, scene.q0, D);
  const PotentialEvaluator<double> plain(potential, 1);
  for (std::size_t t = 0; t < potential.terms.size(); ++t) {
    const EffectCount& count = force.counts()[t];
    if (potential.terms[t].constant_force) {
      EXPECT_EQ(count.evaluations, 1U);
      continue;
    }
    EXPECT_EQ(count.calls, 3U);
    EXPECT_EQ(count.evaluations, 3U);
    EXPECT_GT(count.seconds, 0);
    EXPECT_GT(count.per_evaluation.total(), plain.counts()[t].per_evaluation.total());
  }
}

}  // namespace
}  // namespace hbvm::core
