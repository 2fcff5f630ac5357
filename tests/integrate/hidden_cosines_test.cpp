#include "hbvm/integrate/hidden_cosines.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm {
namespace {

template <Scalar S>
void show(HiddenCosines<S>& cosines, const Problem<S>& problem, const Snapshot<S>& snapshot) {
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(snapshot.q));
  Vector<S> v(problem.m());
  problem.mass.velocity(lanes(snapshot.p), lanes(v));
  cosines.observe(gradient, v, snapshot);
}

TEST(HiddenCosines, AreThoseOfDenseMatrices) {
  for (const char* name : {"double_pendulum", "heavy_top", "bead_on_paraboloid", "scissors"}) {
    SceneRun<double> run(load_scene(name), 2, 2, "1/8", "5");
    const Problem<double>& problem = run.scene.problem;
    Recorder<double> recorder;
    run({&recorder});
    HiddenCosines<double> cosines(problem, run.grid.steps());
    Vector<double> hidden = Vector<double>::Zero(problem.nu()), speed = hidden;
    const Matrix<double> W = dense_inverse(dense_mass(problem.mass));
    for (const Snapshot<double>& snapshot : recorder.seen) {
      show(cosines, problem, snapshot);
      const Matrix<double> G = dense_gradient(problem, snapshot.q);
      const Vector<double> v = W * snapshot.p;
      const Index d = problem.dimension;
      for (Index a = 0; a < problem.nu(); ++a) {
        double sum = 0;
        for (Index b = 0; b < problem.m(); b += d) sum += G.col(a).segment(b, d).norm() * v.segment(b, d).norm();
        raise_to(speed[a], sum);
        raise_to(hidden[a], std::abs(G.col(a).dot(v)));
      }
    }
    const double worst = (hidden.array() / speed.array()).maxCoeff();
    EXPECT_NEAR(cosines.worst().cosine / worst, 1, 1e-6) << name;
    EXPECT_GT(worst, 1e-6) << name;
    EXPECT_LT(worst, 1) << name;
  }
}

class Pendulum : public ::testing::Test {
 protected:
  /// Lowest, with the speed 1, and these velocities along the rod, one a quarter.
  HiddenCosines<double> of(const std::vector<double>& along) {
    HiddenCosines<double> cosines(scene.problem, static_cast<long>(along.size()) - 1);
    long n = 0;
    for (const double velocity : along) {
      Snapshot<double> snapshot{n, double(n), scene.q0, scene.p0, Vector<double>::Constant(1, -double(n))};
      snapshot.q << 0, -1;
      snapshot.p << 1, velocity;
      show(cosines, scene.problem, snapshot);
      ++n;
    }
    return cosines;
  }
  Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
};

TEST_F(Pendulum, LeavesItsCircleAtACosine) {
  const auto worst = of({0, 1e-3, -3e-3, 1e-3}).worst();
  EXPECT_NEAR(worst.cosine, 3e-3, 1e-7);
  EXPECT_EQ(worst.t, 2);
  EXPECT_EQ(of({0, 0}).worst().cosine, 0);
}

/// grad g = 2 q.
TEST_F(Pendulum, IsHeldByForcesOfThisPower) { EXPECT_NEAR(of({0, 0, 0, 0}).power(), 3 * 2, 1e-15); }

TEST_F(Pendulum, GrowsFromTheFirstQuarterToTheLast) {
  EXPECT_NEAR(of({1e-3, -2e-3, 3e-3, -5e-3, 1e-4}).growth(1e-6).factor, 5, 1e-9);
  EXPECT_EQ(of({1e-3, -2e-3, 3e-3, -5e-3, 1e-4}).growth(1e-2).factor, 0) << "below what counts";
  EXPECT_EQ(of({1e-3, 7e-3, 3e-3, 5e-3, 1e-4}).growth(1e-6).factor, 0) << "it came back";
  EXPECT_EQ(of({0, 0, 0, 0, 1e-3}).growth(1e-6).factor, 0) << "nothing to grow from";
}

}  // namespace
}  // namespace hbvm
