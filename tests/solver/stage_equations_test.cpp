#include "hbvm/solver/stage_equations.hpp"

#include "hbvm/scene/assemble.hpp"
#include "printing.hpp"
#include "solver/stage_formulas.hpp"

namespace hbvm {
namespace {

/// The maps of which the stage equations consist, at unknowns that solve nothing.
class StageMaps : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  static Matrix<Mpfr> generic(Index rows, Index columns, int seed) {
    Matrix<Mpfr> a(rows, columns);
    for (Index i = 0; i < a.size(); ++i) a.data()[i] = Mpfr((i * 13 + seed * 29) % 31 - 15) / 17;
    return a;
  }
  void expect_equal(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b, const char* what) const {
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    EXPECT_LE(max_norm(Matrix<Mpfr>(a - b)), 1'000'000 * epsilon<Mpfr>() * (1 + max_norm(b))) << what;
  }

  PrecisionScope digits{50};
  const int k = std::get<0>(GetParam()), s = std::get<1>(GetParam());
  const Mpfr h = Mpfr(1) / 10;
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s);
};

TEST_P(StageMaps, AreThePapersFormulas) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    StageEquations<Mpfr> equations(scene.problem, method, h);
    const StageFormulas formulas(model, k, s, h);
    StageUnknowns<Mpfr> x = equations.make_unknowns();
    x.gamma = generic(s, model.m(), 1);

    equations.start(scene.q0, scene.p0);
    equations.move(x.gamma);
    equations.forces(x.psi);
    expect_equal(x.psi, formulas.psi(scene.q0, x.gamma), "psi");

    x.psi = generic(s, model.m(), 2);
    ASSERT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
    expect_equal(x.zeta, formulas.zeta(scene.q0, x.gamma, x.lambda), "zeta");

    Matrix<Mpfr> gamma = x.gamma;
    equations.momenta(x.psi, x.zeta, gamma);
    const Matrix<Mpfr> v = formulas.velocities(scene.p0, x.psi, x.zeta);
    expect_equal(formulas.velocities(gamma), v, "v");
    // (lam): with the new multipliers v is orthogonal to the gradients at the nodes of the old gamma.
    const Matrix<Mpfr> hidden = formulas.hidden(scene.q0, x.gamma, v);
    expect_equal(hidden, Matrix<Mpfr>::Zero(s, model.nu()), "hidden constraints at the nodes");
  }
}

TEST_P(StageMaps, ChangesOverTheStep) {
  const DenseModel model = ellipsoid_bead();
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
  StageEquations<Mpfr> equations(scene.problem, method, h);
  StageUnknowns<Mpfr> x = equations.make_unknowns();
  x.gamma = generic(s, model.m(), 3);
  x.psi = generic(s, model.m(), 4);
  x.zeta = generic(s, model.m(), 5);
  Vector<Mpfr> q(model.m()), p(model.m());
  equations.changes(x, q, p);
  expect_equal(Matrix<Mpfr>(q.transpose()), Matrix<Mpfr>(x.gamma.row(0) * model.W * h), "h M^-1 gamma_0");
  expect_equal(Matrix<Mpfr>(p.transpose()), Matrix<Mpfr>((x.psi - x.zeta).row(0) * h), "h (psi_0 - zeta_0)");
}

/// At unknowns that a sweep of the fixed-point iteration has made, the residual is what the next one would change.
TEST_P(StageMaps, ResidualIsThatOfThePapersFormulas) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    StageEquations<Mpfr> equations(scene.problem, method, h);
    const StageFormulas formulas(model, k, s, h);
    StageUnknowns<Mpfr> x = equations.make_unknowns();
    x.gamma = generic(s, model.m(), 6);
    x.lambda = generic(s, model.nu(), 7);
    StageResidual<Mpfr> r{x.gamma, x.lambda};
    equations.start(scene.q0, scene.p0);
    equations.residual(x, r);
    expect_equal(x.psi, formulas.psi(scene.q0, x.gamma), "psi");
    expect_equal(x.zeta, formulas.zeta(scene.q0, x.gamma, x.lambda), "zeta");
    const Matrix<Mpfr> v = formulas.velocities(x.gamma);
    expect_equal(formulas.velocities(Matrix<Mpfr>(x.gamma - r.momentum)), formulas.velocities(scene.p0, x.psi, x.zeta),
                 "(dispro1)");
    expect_equal(r.constraint, formulas.hidden(scene.q0, x.gamma, v), "hidden constraints at the nodes");
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, StageMaps,
                         ::testing::Values(std::tuple(1, 1), std::tuple(3, 1), std::tuple(2, 2), std::tuple(5, 3),
                                           std::tuple(5, 5), std::tuple(9, 6)));

TEST(StageEquations, WithoutConstraintsHaveNoMultipliers) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(
      read_scene("dimension = 2\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n", "free"));
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(2, 2);
  StageEquations<Mpfr> equations(scene.problem, method, Mpfr(1));
  StageUnknowns<Mpfr> x = equations.make_unknowns();
  EXPECT_EQ(x.lambda.size(), 0);
  equations.start(scene.q0, scene.p0);
  equations.move(x.gamma);
  EXPECT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
  EXPECT_EQ(max_norm(x.zeta), 0);
}

TEST(StageEquations, ReportASingularSystem) {
  Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  scene.problem.constraints.push_back(scene.problem.constraints[0]);  // the Gram matrix is singular everywhere
  const Hbvm<double> method = make_hbvm<double>(1, 1);
  StageEquations<double> equations(scene.problem, method, 1);
  StageUnknowns<double> x = equations.make_unknowns();
  equations.start(scene.q0, scene.p0);
  equations.move(x.gamma);
  EXPECT_FALSE(equations.multipliers(x.psi, x.lambda, x.zeta));
}

}  // namespace
}  // namespace hbvm
