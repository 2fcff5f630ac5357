#include "integrate/hidden_cosines.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
void show(HiddenCosines<S>& cosines, const Problem<S>& problem, const Snapshot<S>& snapshot) {
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(snapshot.q));
  Vector<S> v(problem.m());
  problem.mass.velocity(lanes(snapshot.p), lanes(v));
  cosines.observe(gradient, v, snapshot);
}

/// The root of the mean square of the speeds of a body's matter.
double speed_of(const MassMatrix<double>::Block& body, const Snapshot<double>& snapshot, const Vector<double>& v) {
  const double mass = body.full ? body.M(0, 0) : body.mass;
  return std::sqrt(snapshot.p.segment(body.offset, body.size).dot(v.segment(body.offset, body.size)) / mass);
}

TEST(HiddenCosines, AreThoseOfDenseMatrices) {
  for (const char* name : {"double_pendulum", "heavy_top", "bead_on_paraboloid", "scissors"}) {
    SceneRun<double> run(load_scene(name), 2, 2, "1/8", "5");
    const Problem<double>& problem = run.scene.problem;
    Recorder<double> recorder;
    run({&recorder});
    HiddenCosines<double> cosines(problem, run.grid.steps());
    Vector<double> hidden = Vector<double>::Zero(problem.nu()), speed = hidden, reach = hidden;
    double fastest = 0;
    const Matrix<double> W = dense_inverse(dense_mass(problem.mass));
    for (const Snapshot<double>& snapshot : recorder.seen) {
      show(cosines, problem, snapshot);
      const Matrix<double> G = dense_gradient(problem, snapshot.q);
      const Vector<double> v = W * snapshot.p;
      for (const auto& body : problem.mass.blocks()) raise_to(fastest, speed_of(body, snapshot, v));
      const Index d = problem.dimension;
      for (Index a = 0; a < problem.nu(); ++a) {
        double sum = 0, of_bodies = 0;
        for (Index b = 0; b < problem.m(); b += d) sum += G.col(a).segment(b, d).norm() * v.segment(b, d).norm();
        for (const auto& body : problem.mass.blocks()) {
          const Vector<double> own = G.col(a).segment(body.offset, body.size);
          const double mass = body.full ? body.M(0, 0) : body.mass;
          of_bodies += std::sqrt(mass * own.dot(W.block(body.offset, body.offset, body.size, body.size) * own));
        }
        raise_to(speed[a], sum);
        if (std::abs(G.col(a).dot(v)) <= hidden[a]) continue;
        hidden[a] = std::abs(G.col(a).dot(v));
        reach[a] = of_bodies;
      }
    }
    const double worst = (hidden.array() / speed.array().max(reach.array() * fastest)).maxCoeff();
    EXPECT_NEAR(cosines.worst(0, 0).cosine / worst, 1, 1e-6) << name;
    EXPECT_GT(worst, 1e-6) << name;
    EXPECT_LT(worst, 1) << name;
  }
}

/// A pendulum's mass at rest and, on a rod to it, a body that moves at speed 3; another pendulum moves at speed 100.
class Linkage : public ::testing::Test {
 protected:
  /// With the first body at this speed along its rod.
  HiddenCosines<double> of(double along) {
    HiddenCosines<double> cosines(scene.problem, 1);
    Snapshot<double> snapshot{0, 0, scene.q0, scene.p0, Vector<double>::Constant(3, 5)};
    snapshot.p[1] += along;
    show(cosines, scene.problem, snapshot);
    return cosines;
  }
  Assembled<double> scene = assemble<double>(
      read_scene("dimension = 2\npoint = [{name = \"o\", position = [0, 0]}, {name = \"far\", position = [9, 0]}]\n"
                 "body = [{name = \"a\", mass = 1, position = [0, -1], velocity = [0, 0]},\n"
                 "{name = \"b\", mass = \"1/4\", position = [0, -3], velocity = [3, 0]},\n"
                 "{name = \"c\", mass = 8, position = [9, -1], velocity = [100, 0]}]\n"
                 "constraint = [{kind = \"rod\", between = [\"o\", \"a\"], length = 1},\n"
                 "{kind = \"rod\", between = [\"a\", \"b\"], length = 2},\n"
                 "{kind = \"rod\", between = [\"far\", \"c\"], length = 1}]\n",
                 "linkage"));
};

TEST_F(Linkage, AtRestIsMeasuredByTheSpeedOfWhatIsJoinedToIt) {
  // grad g = 2 q of the first rod, whose body alone has a speed of 1e-3.
  const auto worst = of(1e-3).worst(0, 0);
  EXPECT_EQ(worst.constraint, 0);
  EXPECT_NEAR(worst.cosine, 1e-3 / 3, 1e-9);
}

TEST_F(Linkage, AtRestDoesNotCountWhatForcesLeaveByRounding) {
  // The three forces over the roots of the masses: |2|, |4 (1, 2)| and |2 / sqrt(8)|, times lambda 5.
  const double force = 5 * (2 + std::sqrt(16 + 64.0) + 2 / std::sqrt(8.0));
  const auto least = [&](double along) { return 2 * along / (2 * force); };
  EXPECT_GT(of(1e-9).worst(1, least(1e-9) / 1.01).cosine, 0);
  EXPECT_EQ(of(1e-9).worst(1, least(1e-9) * 1.01).cosine, 0);
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
  const auto worst = of({0, 1e-3, -3e-3, 1e-3}).worst(0, 0);
  EXPECT_NEAR(worst.cosine, 3e-3, 1e-7);
  EXPECT_EQ(worst.t, 2);
  EXPECT_EQ(of({0, 0}).worst(0, 0).cosine, 0);
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
}  // namespace hbvm::core
