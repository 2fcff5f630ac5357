#include "integrate/constraint_angles.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// 1/sin^2 of the angles and the squared lengths by dense matrices.
template <Scalar S>
std::pair<Vector<S>, Vector<S>> dense_angles(const Problem<S>& problem, const Vector<S>& q) {
  const Matrix<S> G = dense_gradient(problem, q);
  Matrix<S> C = G.transpose() * Matrix<S>(dense_inverse(dense_mass(problem.mass)) * G);
  const Vector<S> squares = C.diagonal();
  const Matrix<S> inverse = dense_inverse(C);
  Vector<S> angles(problem.nu());
  for (Index a = 0; a < problem.nu(); ++a) angles[a] = inverse(a, a) * squares[a];
  return {angles, squares};
}

template <Scalar S>
void show(ConstraintAngles<S>& angles, const Problem<S>& problem, const Snapshot<S>& snapshot) {
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(snapshot.q));
  angles.observe(gradient, snapshot);
}

TEST(ConstraintAngles, AreThoseOfDenseMatrices) {
  const PrecisionScope digits(50);
  for (const char* name : {"four_bar_linkage", "double_pendulum", "heavy_top", "chain", "bead_on_paraboloid"}) {
    SceneRun<Mpfr> run(load_scene(name), 2, 2, "1/8", "5");
    const Problem<Mpfr>& problem = run.scene.problem;
    Recorder<Mpfr> recorder;
    run({&recorder});
    ConstraintAngles<Mpfr> angles(problem);
    Mpfr closest = 0, closest_t = 0, factor = 1, factor_t = 0;
    std::pair<Vector<Mpfr>, Vector<Mpfr>> before;
    for (const Snapshot<Mpfr>& snapshot : recorder.seen) {
      show(angles, problem, snapshot);
      const auto now = dense_angles(problem, snapshot.q);
      if (max_norm(now.first) > closest) {
        closest = max_norm(now.first);
        closest_t = snapshot.t;
      }
      for (Index a = 0; snapshot.n > 0 && a < problem.nu(); ++a)
        for (Mpfr ratio : {Mpfr(now.first[a] / before.first[a]), Mpfr(now.second[a] / before.second[a])}) {
          if (ratio < 1) ratio = 1 / ratio;
          if (!(sqrt(ratio) > factor)) continue;
          factor = sqrt(ratio);
          factor_t = snapshot.t;
        }
      before = now;
    }
    const auto& change = angles.greatest_change();
    EXPECT_NEAR(change.factor, approximately(factor), 1e-9 * change.factor) << name;
    if (change.factor > 1 + 1e-6) {
      EXPECT_EQ(change.t, factor_t) << name;
    }
    // Of a rigid body the angles stay the same but for round-off, and any time is right.
    Mpfr there = 0;
    for (const Snapshot<Mpfr>& snapshot : recorder.seen)
      if (snapshot.t == angles.closest_t()) there = max_norm(dense_angles(problem, snapshot.q).first);
    EXPECT_LE(closest - there, literal<Mpfr>("1e-40") * closest) << name << " at " << closest_t;
  }
}

/// A body between two pins, `height` above the line that joins them: there the rods' gradients are parallel.
const std::string between_pins =
    "dimension = 2\npoint = [{name = \"l\", position = [-1, 0]}, {name = \"r\", position = [2, 0]}]\n"
    "body = [{name = \"b\", mass = 3, position = [0, 1], velocity = [0, 0]}]\n"
    "constraint = [{kind = \"rod\", between = [\"l\", \"b\"], length = \"sqrt(2)\"},\n"
    "{kind = \"rod\", between = [\"b\", \"r\"], length = \"sqrt(5)\"}]\n";

template <class S>
class Crossing : public InDigits<50> {
 protected:
  /// The greatest factor between neighbours at these heights.
  double factor(const std::vector<S>& heights, Index* constraint = nullptr) {
    const Assembled<S> scene = assemble<S>(read_scene(between_pins, "between pins"));
    ConstraintAngles<S> angles(scene.problem);
    long n = 0;
    for (const S& height : heights) {
      Snapshot<S> snapshot{n, S(n), scene.q0, scene.p0, {}};
      snapshot.q[1] = height;
      show(angles, scene.problem, snapshot);
      ++n;
    }
    if (constraint) *constraint = angles.greatest_change().constraint;
    return angles.greatest_change().factor;
  }
};
TYPED_TEST_SUITE(Crossing, AllScalars, ScalarNames);

TYPED_TEST(Crossing, OfASingularPositionChangesASineThreefoldWhereverTheMeshLies) {
  using S = TypeParam;
  const S step = sqrt(epsilon<S>()) * 1000;  // condition 1e-6/epsilon: more than double could tell apart with 50 digits
  for (const char* offset : {"1/2", "0.4", "0.1", "1e-3"}) {
    std::vector<S> heights;
    for (int n = -2; n <= 3; ++n) heights.push_back(step * (S(n) - literal<S>(offset)));
    EXPECT_GT(this->factor(heights), 2.9) << offset;
  }
}

TYPED_TEST(Crossing, ThatTheStepsResolveDoesNot) {
  using S = TypeParam;
  std::vector<S> heights;
  for (int n = -30; n <= 30; ++n) heights.push_back(literal<S>("1e-5") * sqrt(S(1 + n * n / S(4))));
  EXPECT_LT(this->factor(heights), 2);
  heights.clear();
  for (int n = -3; n <= 3; ++n) heights.push_back(literal<S>("1e-5") * sqrt(S(1 + 100 * n * n)));
  EXPECT_GT(this->factor(heights), 2);
}

/// Where the Gram matrix in double has no digit left, other precisions still have theirs.
TYPED_TEST(Crossing, IsSeenInTheDigitsItTakes) {
  using S = TypeParam;
  const bool in_double = std::same_as<S, double>;
  for (const char* height : {"1e-5", "2e-8", "1e-12"}) {
    if (in_double && std::string(height) != "1e-5") continue;
    const S h = literal<S>(height);
    EXPECT_NEAR(this->factor({h, S(h * 5 / 4)}), 5 / double{4}, in_double ? 1e-4 : 1e-6) << height;
  }
}

TYPED_TEST(Crossing, ThroughTheSingularPositionItselfIsSeenAround) {
  using S = TypeParam;
  std::vector<S> heights;
  for (int n = -3; n <= 3; ++n) heights.push_back(S(n) / 64);
  EXPECT_GT(this->factor(heights), 1.9);  // from 3 to 2, then the singular one, which has no finite condition
}

TEST(ConstraintAngles, SeeAGradientVanish) {
  // The apex of the cone x^2 = y^2.
  const Scene scene = read_scene(
      "dimension = 2\nbody = [{name = \"b\", mass = 1, position = [1, 1], velocity = [0, 0]}]\n"
      "constraint = [{kind = \"quadric\", body = \"b\", A = [[1, 0], [0, -1]], b = [0, 0], c = 0}]\n",
      "cone");
  const Assembled<double> assembled = assemble<double>(scene);
  ConstraintAngles<double> angles(assembled.problem);
  for (long n = 0; n < 5; ++n) {
    Snapshot<double> snapshot{n, double(n), assembled.q0, assembled.p0, {}};
    snapshot.q *= (2.5 - double(n)) / 1000;
    show(angles, assembled.problem, snapshot);
  }
  EXPECT_TRUE(angles.greatest_change().of_length);
  EXPECT_NEAR(angles.greatest_change().factor, 3, 1e-12);
  EXPECT_EQ(angles.greatest_change().t, 2);
}

}  // namespace
}  // namespace hbvm::core
