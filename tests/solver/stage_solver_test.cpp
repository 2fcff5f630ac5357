#include "solver/stage_solver.hpp"

#include "integrate/runs.hpp"
#include "plain_step/mechanics.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

using Methods = std::vector<std::pair<int, int>>;
const Methods methods{{1, 1}, {2, 1}, {2, 2}, {3, 2}, {3, 3}, {5, 3}, {4, 4}, {6, 4}, {5, 5}, {8, 5}};

std::string in_words(int k, int s) { return ", HBVM(" + std::to_string(k) + "," + std::to_string(s) + "), "; }

class StageSolution : public InDigits<50>, public ::testing::WithParamInterface<SolverKind> {};

TEST_P(StageSolution, FulfilsTheEquationsOfThePlainStep) {
  const Mpfr h = Mpfr(1) / 20;
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    for (const auto& [k, s] : methods) {
      const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s);
      const plain::Step<Mpfr> plain_step(mechanics_of(model), k, s, s, h);
      const std::string where = in_words(k, s);
      const auto solver = make_solver(GetParam(), scene.problem, method);
      Vector<Mpfr> q0 = scene.q0, p0 = scene.p0;
      for (int step = 0; step < 3; ++step) {  // from the second on started from the step before
        solver->solve({q0, p0, h});
        const StageUnknowns<Mpfr>& x = solver->unknowns();
        // 50 digits, and sums of some twenty terms.
        const Mpfr tolerance = 1'000'000 * epsilon<Mpfr>();
        const auto expect_small = [&](const Vector<Mpfr>& residual, const char* what) {
          EXPECT_LE(max_norm(residual), tolerance) << what << where << "step " << step;
        };
        const Vector<Mpfr> gamma = blocks_of(x.gamma), psi = blocks_of(x.psi), zeta = blocks_of(x.zeta);
        const Matrix<Mpfr> G = plain_step.grad_g(plain_step.u(q0, gamma));
        expect_small(psi - plain_step.forces(plain_step.u_hat(q0, gamma)), "psi");
        expect_small(zeta - plain_step.pulls(G, blocks_of(x.lambda)), "zeta");
        expect_small(gamma - plain_step.momenta(plain_step.v(p0, psi, zeta)), "gamma, (54)");
        const Matrix<Mpfr> v = method.P_s.lazyProduct(x.gamma);
        expect_small(plain_step.hidden(G, blocks_of(v)), "grad g(u)^T M^-1 v");
        q0 += solver->change().q;
        p0 += solver->change().p;
        EXPECT_LE(max_norm(model.g(q0)), tolerance) << "g";
      }
    }
  }
}

TEST_P(StageSolution, DoesNotDependOnEarlierSteps) {
  const DenseModel model = ellipsoid_bead();
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(4, 3);
  const Mpfr h = Mpfr(1) / 10;
  const auto fresh = make_solver(GetParam(), scene.problem, method);
  fresh->solve({scene.q0, scene.p0, h});
  const auto used = make_solver(GetParam(), scene.problem, method);
  const Vector<Mpfr> elsewhere = -scene.p0;
  used->solve({scene.q0, elsewhere, h});
  used->solve({scene.q0, scene.p0, h});
  const Mpfr difference = max_norm(Matrix<Mpfr>(fresh->unknowns().gamma - used->unknowns().gamma));
  EXPECT_LE(difference, 1'000 * epsilon<Mpfr>());
}

INSTANTIATE_TEST_SUITE_P(Solvers, StageSolution, ::testing::Values(SolverKind::fixed_point, SolverKind::paper),
                         [](const ::testing::TestParamInfo<SolverKind>& kind) {
                           return kind.param == SolverKind::paper ? "Paper" : "FixedPoint";
                         });

Integration<Mpfr> run(const Scene& text, SolverKind kind, int k, int s, const char* step, const char* until) {
  return SceneRun<Mpfr>(text, k, s, step, until, kind)({});
}

TEST(Solvers, GiveTheSameDigits) {
  const PrecisionScope digits(50);
  std::vector<Scene> scenes;
  for (const char* name : {"simple_pendulum", "modified_pendulum", "conical_pendulum", "tethered_satellites"})
    scenes.push_back(load_scene(name));
  for (const char* name : {"double_pendulum", "spherical_pendulum", "ellipsoid_bead"})
    scenes.push_back(load_scene(scene_path(name)));
  scenes.push_back(read_scene(bead_on_curve().scene, "bead_on_curve"));
  for (const Scene& scene : scenes)
    for (const auto& [k, s] : methods) {
      const std::string where = in_words(k, s) + scene.name + ", ";
      for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::newton}) {
        const auto mine = run(scene, kind, k, s, "1/16", "1/4");
        const auto papers = run(scene, SolverKind::paper, k, s, "1/16", "1/4");
        const auto expect_same = [&](const Vector<Mpfr>& a, const Vector<Mpfr>& b, long round_off, const char* what) {
          EXPECT_LE(max_norm(Vector<Mpfr>(a - b)), round_off * epsilon<Mpfr>()) << what << where << name_of(kind);
        };
        // The start at distance 20 costs the satellites two digits. The multiplier at the end is extrapolated from
        // those at the nodes, which are differences of p over 1/16 of a step's part.
        expect_same(mine.end.q, papers.end.q, 100'000, "q");
        expect_same(mine.end.p, papers.end.p, 100'000, "p");
        expect_same(mine.end.lambda, papers.end.lambda, 1'000'000, "lambda");
      }
    }
}

/// After some steps the start has half of the digits: one sweep then changes psi, but not gamma, by much.
TEST(Solvers, GiveTheSameDigitsFromAGoodStart) {
  const PrecisionScope digits(34);
  const Scene kepler = load_scene("kepler");
  const auto papers = run(kepler, SolverKind::paper, 2, 2, "1/100", "2");
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::newton}) {
    const auto mine = run(kepler, kind, 2, 2, "1/100", "2");
    EXPECT_LE(distance(mine.end.q, papers.end.q), 10'000 * epsilon<Mpfr>()) << name_of(kind);
    EXPECT_LE(distance(mine.end.p, papers.end.p), 10'000 * epsilon<Mpfr>()) << name_of(kind);
  }
}

TEST(Solvers, NewestValuesAndAWarmStartNeedFewerSweeps) {
  const PrecisionScope digits(50);
  const Scene bead = load_scene(scene_path("ellipsoid_bead"));
  const auto mine = run(bead, SolverKind::fixed_point, 4, 3, "1/32", "1");
  const auto papers = run(bead, SolverKind::paper, 4, 3, "1/32", "1");
  EXPECT_LT(mine.sweeps, papers.sweeps);
}

}  // namespace
}  // namespace hbvm::core
