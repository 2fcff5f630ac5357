#include "solver/stage_equations.hpp"

#include "basis/gauss_legendre.hpp"
#include "basis/legendre.hpp"
#include "linear/product.hpp"
#include "method/hbvm_name.hpp"
#include "plain_step/mechanics.hpp"
#include "printing.hpp"
#include "problem/in_double.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
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

  void expect_same_blocks(const Matrix<Mpfr>& a, const Vector<Mpfr>& blocks, const char* what) const {
    expect_equal(a, rows_of(blocks, a.cols()), what);
  }

  PrecisionScope digits{50};
  const int k = std::get<0>(GetParam()), s = std::get<1>(GetParam());
  const Mpfr h = Mpfr(1) / 10;
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s);
};

TEST_P(StageMaps, AreThoseOfThePlainStep) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    StageEquations<Mpfr> equations(scene.problem, method);
    const plain::Step<Mpfr> plain_step(mechanics_of(model), k, s, s, h);
    StageUnknowns<Mpfr> x = equations.make_unknowns();
    x.gamma = generic(s, model.m(), 1);
    const Vector<Mpfr> gamma_0 = blocks_of(x.gamma);
    const Matrix<Mpfr> G = plain_step.grad_g(plain_step.u(scene.q0, gamma_0));

    equations.start({scene.q0, scene.p0, h});
    equations.move(x.gamma);
    equations.forces(x.psi);
    expect_same_blocks(x.psi, plain_step.forces(plain_step.u_hat(scene.q0, gamma_0)), "psi");

    x.psi = generic(s, model.m(), 2);
    ASSERT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
    expect_same_blocks(x.lambda, plain_step.multipliers(G, scene.p0, blocks_of(x.psi)), "lambda");
    expect_same_blocks(x.zeta, plain_step.pulls(G, blocks_of(x.lambda)), "zeta");

    Matrix<Mpfr> gamma = x.gamma;
    equations.momenta(x.psi, x.zeta, gamma);
    const Vector<Mpfr> v = plain_step.v(scene.p0, blocks_of(x.psi), blocks_of(x.zeta));
    expect_same_blocks(gamma, plain_step.momenta(v), "gamma");
  }
}

TEST_P(StageMaps, ChangesOverTheStep) {
  const DenseModel model = ellipsoid_bead();
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
  StageEquations<Mpfr> equations(scene.problem, method);
  StageUnknowns<Mpfr> x = equations.make_unknowns();
  x.gamma = generic(s, model.m(), 3);
  x.psi = generic(s, model.m(), 4);
  x.zeta = generic(s, model.m(), 5);
  StepChange<Mpfr> change(model.m());
  equations.start({scene.q0, scene.p0, h});
  equations.changes(x, change);
  expect_equal(Matrix<Mpfr>(change.q.transpose()), Matrix<Mpfr>(x.gamma.row(0) * model.W * h), "h M^-1 gamma_0");
  expect_equal(Matrix<Mpfr>(change.p.transpose()), Matrix<Mpfr>((x.psi - x.zeta).row(0) * h), "h (psi_0 - zeta_0)");
}

/// A constant force of 1/10 beside a force of the constraint of 8: what rounding of their sum takes is not lost.
TEST(StepChanges, KeepWhatRoundingTakesFromTheForces) {
  const std::string falling =
      "dimension = 2\n[[body]]\nname = \"a\"\nmass = 3\nposition = [0, 1]\nvelocity = [1, 0]\n"
      "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0.1, 0]\n";
  const std::string spring =
      "[[point]]\nname = \"sun\"\nposition = [0, 0]\n"
      "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1e-9\n";
  for (const bool varying : {false, true}) {
    const auto scene = assemble<double>(read_scene(falling + (varying ? spring : ""), "scene"));
    const double h = 0.125;
    const auto method = make_hbvm<double>(2, 2);
    StageEquations<double> equations(scene.problem, method);
    equations.start({scene.q0, scene.p0, h});
    StageUnknowns<double> x = equations.make_unknowns();
    x.gamma.row(0) = scene.p0.transpose();
    equations.move(x.gamma);
    equations.forces(x.psi);
    x.zeta(0, 0) = 8.3;
    StepChange<double> change(2);
    equations.changes(x, change);

    const Quad force = Quad(scene.problem.mass.blocks()[0].mass) * Quad(0.1);
    PotentialEvaluator<double> potential(scene.problem.potential, 2);
    Matrix<double> at_nodes = Matrix<double>::Zero(2, 2);
    if (varying) potential.varying_force(lanes(equations.quadrature_positions()), at_nodes);
    Matrix<double> psi(2, 2);
    product(psi, method.projection_hat, at_nodes);
    const Quad constant = potential.constant_force()[0];
    EXPECT_LE(magnitude(Quad(constant - force)), Quad(epsilon<double>()));
    const Quad exact = Quad(h) * (Quad(psi(0, 0)) + constant - Quad(8.3));
    const Quad lost = exact - Quad(change.p[0]);
    EXPECT_NE(lost, 0);
    EXPECT_LE(magnitude(Quad(lost - Quad(change.p_rest[0]))), magnitude(lost) * Quad(epsilon<double>()));
  }
}

/// At unknowns that a sweep of the fixed-point iteration has made, the residual is what the next one would change.
TEST_P(StageMaps, ResidualIsThatOfThePlainStep) {
  for (const DenseModel& model : {double_pendulum(), ellipsoid_bead(), bead_on_curve()}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(model.scene, "model"));
    StageEquations<Mpfr> equations(scene.problem, method);
    const plain::Step<Mpfr> plain_step(mechanics_of(model), k, s, s, h);
    StageUnknowns<Mpfr> x = equations.make_unknowns();
    x.gamma = generic(s, model.m(), 6);
    x.lambda = generic(s, model.nu(), 7);
    StageResidual<Mpfr> r{x.gamma, x.lambda};
    equations.start({scene.q0, scene.p0, h});
    equations.residual(x, r);
    const Vector<Mpfr> gamma = blocks_of(x.gamma), psi = blocks_of(x.psi), zeta = blocks_of(x.zeta);
    const Matrix<Mpfr> G = plain_step.grad_g(plain_step.u(scene.q0, gamma));
    expect_same_blocks(x.psi, plain_step.forces(plain_step.u_hat(scene.q0, gamma)), "psi");
    expect_same_blocks(x.zeta, plain_step.pulls(G, blocks_of(x.lambda)), "zeta");
    expect_same_blocks(r.momentum, gamma - plain_step.momenta(plain_step.v(scene.p0, psi, zeta)), "gamma, (54)");
    const Matrix<Mpfr> v = method.P_s.lazyProduct(x.gamma);
    expect_same_blocks(r.constraint, plain_step.hidden(G, blocks_of(v)), "hidden constraints at the nodes");
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, StageMaps,
                         ::testing::Values(std::tuple(1, 1), std::tuple(3, 1), std::tuple(2, 2), std::tuple(5, 3),
                                           std::tuple(5, 5), std::tuple(9, 6)));

/// The residual and the multipliers of any constraint at r nodes, node by node from their definitions.
TEST(StageEquations, OfAnyConstraintAreItsLegendreCoefficients) {
  const PrecisionScope digits(50);
  const Mpfr h = Mpfr(1) / 10, tolerance = 1'000'000 * epsilon<Mpfr>();
  for (const char* name : {"bead_on_torus", "rope_over_two_pegs", "rod_on_two_curves", "heavy_top"})
    for (const HbvmName& n : {HbvmName{1, 1, 2}, {3, 2, 4}, {4, 3, 4}, {5, 3, 7}}) {
      const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
      const Problem<Mpfr>& problem = scene.problem;
      const Hbvm<Mpfr> method = make_hbvm<Mpfr>(n.k, n.s, n.r);
      StageEquations<Mpfr> equations(problem, method);
      StageUnknowns<Mpfr> x = equations.make_unknowns();
      for (Index i = 0; i < x.gamma.size(); ++i) x.gamma.data()[i] = Mpfr((i * 13 + 29) % 31 - 15) / 170;
      for (Index i = 0; i < x.lambda.size(); ++i) x.lambda.data()[i] = Mpfr((i * 17 + 5) % 31 - 15) / 17;
      x.gamma.row(0) += scene.p0.transpose();
      StageResidual<Mpfr> residual{x.gamma, x.lambda};
      equations.start({scene.q0, scene.p0, h});
      equations.residual(x, residual);

      const Quadrature<Mpfr> gauss = gauss_legendre<Mpfr>(n.r);
      const Matrix<Mpfr> P = legendre_values<Mpfr>(gauss.c, n.s), I = legendre_integrals<Mpfr>(gauss.c, n.s);
      StateEvaluator<Mpfr> point(problem);
      ConstraintGradient<Mpfr> gradient(problem, 1);
      const auto coefficients = [&](const Matrix<Mpfr>& of_v, Matrix<Mpfr>& zeta, Matrix<Mpfr>& hidden) {
        zeta.setZero(n.s, problem.m());
        hidden.setZero(n.s, problem.nu());
        for (Index i = 0; i < n.r; ++i) {
          const Vector<Mpfr> moved = Matrix<Mpfr>(I.row(i).lazyProduct(x.gamma)).transpose();
          Vector<Mpfr> u(problem.m());
          problem.mass.velocity(lanes(moved), lanes(u));
          u = scene.q0 + h * u;
          const Vector<Mpfr> v = Matrix<Mpfr>(P.row(i).lazyProduct(of_v)).transpose();
          const Matrix<Mpfr> lambda = P.row(i).lazyProduct(x.lambda);
          Vector<Mpfr> pull = Vector<Mpfr>::Zero(problem.m());
          gradient.update(lanes(std::as_const(u)));
          gradient.add_times(lambda, lanes(pull));
          const Vector<Mpfr> w = point.hidden_constraints(u, v);
          for (Index j = 0; j < n.s; ++j) {
            zeta.row(j) += gauss.b[i] * P(i, j) * pull.transpose();
            hidden.row(j) += gauss.b[i] * P(i, j) * w.transpose();
          }
        }
      };
      Matrix<Mpfr> zeta, hidden;
      coefficients(x.gamma, zeta, hidden);
      EXPECT_LE(max_norm(Matrix<Mpfr>(x.zeta - zeta)), tolerance) << name << ' ' << n.text();
      EXPECT_LE(max_norm(Matrix<Mpfr>(residual.constraint - hidden)), tolerance) << name << ' ' << n.text();
      Matrix<Mpfr> momentum = x.gamma - h * method.X_s.lazyProduct(Matrix<Mpfr>(x.psi - zeta));
      momentum.row(0) -= scene.p0.transpose();
      EXPECT_LE(max_norm(Matrix<Mpfr>(residual.momentum - momentum)), tolerance) << name << ' ' << n.text();

      // With the new multipliers the momenta have no hidden constraint in those coefficients.
      equations.move(x.gamma);
      equations.forces(x.psi);
      ASSERT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
      Matrix<Mpfr> gamma = x.gamma;
      equations.momenta(x.psi, x.zeta, gamma);
      coefficients(gamma, zeta, hidden);
      EXPECT_LE(max_norm(Matrix<Mpfr>(x.zeta - zeta)), tolerance) << name << ' ' << n.text();
      EXPECT_LE(max_norm(hidden), tolerance) << name << ' ' << n.text();
    }
}

TEST(StageEquations, WithoutConstraintsHaveNoMultipliers) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(
      read_scene("dimension = 2\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n", "free"));
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(2, 2);
  StageEquations<Mpfr> equations(scene.problem, method);
  StageUnknowns<Mpfr> x = equations.make_unknowns();
  EXPECT_EQ(x.lambda.size(), 0);
  equations.start({scene.q0, scene.p0, Mpfr(1)});
  equations.move(x.gamma);
  EXPECT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
  EXPECT_EQ(max_norm(x.zeta), 0);
}

/// Far from the origin displacements have few digits in double; rounded from more digits they have all.
TEST(StageEquations, RoundThoseOfMoreDigits) {
  const PrecisionScope digits(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("tethered_satellites"));
  const Problem<double> rounded_problem = in_double(scene.problem);
  for (const auto& [k, s] : {std::pair(3, 3), {5, 2}}) {
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s);
    const Hbvm<double> rounded_method = in_double(method);
    StageEquations<Mpfr> equations(scene.problem, method);
    StageEquations<double> rounded(rounded_problem, rounded_method);
    StageUnknowns<Mpfr> x = equations.make_unknowns();
    StageUnknowns<double> rounded_x = rounded.make_unknowns();
    for (Index i = 0; i < x.gamma.size(); ++i) x.gamma.data()[i] = Mpfr((i * 13) % 31 - 15) / 17;
    rounded_x.gamma = in_double(x.gamma);
    const Mpfr h = Mpfr(1) / 10;
    const double rounded_h = approximately(h);
    const Vector<double> q0 = in_double(scene.q0), p0 = in_double(scene.p0);
    StageResidual<Mpfr> r{x.gamma, x.lambda};
    StageResidual<double> rounded_r{rounded_x.gamma, rounded_x.lambda};
    equations.start({scene.q0, scene.p0, h});
    equations.residual(x, r);
    rounded.start({q0, p0, rounded_h});
    rounded.residual(rounded_x, rounded_r);

    const Matrix<double> gradient = in_double(equations.constraint_gradient().values()),
                         weighted = in_double(equations.constraint_gradient().weighted_values());
    EXPECT_GT(max_norm(Matrix<double>(rounded.constraint_gradient().values() - gradient)), 4 * epsilon<double>());
    rounded.round(equations);
    EXPECT_EQ(rounded.constraint_gradient().values(), gradient);
    EXPECT_EQ(rounded.constraint_gradient().weighted_values(), weighted);
    EXPECT_EQ(rounded.node_positions(), in_double(equations.node_positions()));
    EXPECT_EQ(rounded.quadrature_positions(), in_double(equations.quadrature_positions()));
    EXPECT_EQ(rounded.node_velocities(), in_double(equations.node_velocities()));
  }
}

TEST(StageEquations, ReportASingularSystem) {
  Assembled<double> scene = assemble<double>(load_scene("simple_pendulum"));
  scene.problem.constraints.push_back(scene.problem.constraints[0]);  // the Gram matrix is singular everywhere
  const Hbvm<double> method = make_hbvm<double>(1, 1);
  StageEquations<double> equations(scene.problem, method);
  StageUnknowns<double> x = equations.make_unknowns();
  equations.start({scene.q0, scene.p0, 1});
  equations.move(x.gamma);
  EXPECT_FALSE(equations.multipliers(x.psi, x.lambda, x.zeta));
}

/// What is announced is what is counted.
TEST(StageEquationsCost, OfAResidualIsTheSumOfItsParts) {
  for (const char* name :
       {"modified_pendulum", "kepler", "tethered_satellites", "double_pendulum", "bead_on_torus", "rope_over_two_pegs"})
    for (const auto& [k, s, nodes] : {HbvmName{2, 2, 2}, {5, 3, 3}, {2, 2, 3}, {5, 3, 5}}) {
      const Assembled<double> scene = assemble<double>(load_scene(name));
      const Hbvm<double> method = make_hbvm<double>(k, s, nodes);
      StageEquations<double> equations(scene.problem, method);
      StageUnknowns<double> x = equations.make_unknowns();
      StageResidual<double> r{x.gamma, x.lambda};
      equations.start({scene.q0, scene.p0, 1.0 / 16});
      equations.residual(x, r);
      equations.residual(x, r);
      OperationCounts counted;
      for (std::size_t t = 0; t < equations.effect_counts().size(); ++t)
        if (!scene.problem.potential.terms[t].constant_force)
          counted += equations.effect_counts()[t].evaluations *
                     (equations.effect_counts()[t].per_evaluation - equations.effect_counts()[t].done_before);
      for (const PartCount& part : equations.part_counts()) counted += part.calls * part.per_call;
      EXPECT_EQ(2 * equations.residual_operations(), counted) << name << ' ' << k << ',' << s;
    }
}

}  // namespace
}  // namespace hbvm::core
