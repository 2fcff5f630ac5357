#include "run/proof/ball_stages.hpp"

#include "printing.hpp"
#include "reference/proof/holds.hpp"
#include "scalar/literal.hpp"
#include "solver/stage_solver.hpp"

namespace hbvm::core {
namespace {

struct Case {
  const char* scene;
  HbvmName method;
};
const std::vector<Case>& cases() {
  static const std::vector<Case> all{{"tethered_satellites", {5, 3, 3}},
                                     {"heavy_top", {3, 3, 3}},
                                     {"bead_on_torus", {4, 3, 5}},
                                     {"four_bar_linkage_of_bars", {2, 2, 2}},
                                     {"kepler", {3, 1, 1}}};
  return all;
}

/// Unknowns near a scene's start that solve nothing.
StageUnknowns<Mpfr> some_unknowns(StageEquations<Mpfr>& equations, const Assembled<Mpfr>& scene) {
  StageUnknowns<Mpfr> x = equations.make_unknowns();
  for (Index l = 0; l < x.gamma.rows(); ++l) {
    for (Index j = 0; j < x.gamma.cols(); ++j) x.gamma(l, j) = scene.p0[j] / (l + 1) + Mpfr(j + 2 * l + 1) / 7;
    for (Index a = 0; a < x.lambda.cols(); ++a) x.lambda(l, a) = Mpfr(a + 3 * l + 1) / 5;
  }
  return x;
}

StageBox box_of(const BallStages& stages, const Assembled<Mpfr>& scene, const StageUnknowns<Mpfr>& x) {
  const Index m = scene.problem.m();
  StageBox box{BallMatrix(2 * m, 1), BallMatrix(stages.unknowns(), 1)};
  for (Index j = 0; j < m; ++j) {
    box.start.set(j, 0, exact_ball(raw(scene.q0[j])));
    box.start.set(m + j, 0, exact_ball(raw(scene.p0[j])));
  }
  for (Index l = 0; l < x.gamma.rows(); ++l) {
    for (Index j = 0; j < m; ++j) box.unknowns.set(stages.of_gamma(l, j), 0, exact_ball(raw(x.gamma(l, j))));
    for (Index a = 0; a < x.lambda.cols(); ++a)
      box.unknowns.set(stages.of_lambda(l, a), 0, exact_ball(raw(x.lambda(l, a))));
  }
  return box;
}

/// The residual that the solvers have with 80 digits is in balls of 40.
TEST(BallStages, HoldWhatTheSolversHave) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.scene);
    const PrecisionScope digits(80);
    const ProvedScene scene(load_scene(c.scene));
    const Problem<Mpfr>& problem = scene.rounded.problem;
    const BallProblem balls = scene.balls();
    const BallScope bits(140);
    const BallMethod ball_method = make_ball_method(c.method.k, c.method.s, c.method.r);
    const BallStages stages(balls, ball_method, RealBall(1) / RealBall(8));
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(c.method.k, c.method.s, c.method.r);
    StageEquations<Mpfr> equations(problem, method);
    const Mpfr h = Mpfr(1) / 8;
    equations.start({scene.rounded.q0, scene.rounded.p0, h});
    StageUnknowns<Mpfr> x = some_unknowns(equations, scene.rounded);
    const StageBox box = box_of(stages, scene.rounded, x);
    const StageImage image = stages.image(box);
    StageResidual<Mpfr> residual{x.gamma, x.lambda};
    equations.residual(x, residual);
    const auto expect_in = [&](const RealBall& ball, const Mpfr& number, const std::string& what) {
      EXPECT_TRUE(holds(ball, number)) << what << ": " << text_of(ball) << " and " << number;
      EXPECT_LT(radius_of(ball), 1e-33) << what;
    };
    for (Index l = 0; l < method.s; ++l) {
      for (Index j = 0; j < problem.m(); ++j)
        expect_in(image.residual.at(stages.of_gamma(l, j), 0), residual.momentum(l, j), "momentum");
      for (Index a = 0; a < problem.nu(); ++a)
        expect_in(image.residual.at(stages.of_lambda(l, a), 0), residual.constraint(l, a), "constraint");
    }
    StepChange<Mpfr> change(problem.m());
    equations.changes(x, change);
    for (Index j = 0; j < problem.m(); ++j) {
      expect_in(image.end.at(j, 0), scene.rounded.q0[j] + change.q[j], "q1");
      expect_in(image.end.at(problem.m() + j, 0), scene.rounded.p0[j] + change.p[j], "p1");
    }
    std::vector<RealBall> at_end = stages.multipliers_at_end(box.unknowns);
    for (Index a = 0; a < problem.nu(); ++a)
      expect_in(at_end[static_cast<std::size_t>(a)], method.lambda_at_1.dot(x.lambda.col(a)), "multiplier at the end");
  }
}

/// Derivatives in a small box are differences of images, to many digits.
TEST(BallStages, DerivativesAreThoseOfTheImage) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.scene);
    const PrecisionScope digits(80);
    const ProvedScene scene(load_scene(c.scene));
    const BallProblem balls = scene.balls();
    const BallScope bits(240);
    const BallMethod ball_method = make_ball_method(c.method.k, c.method.s, c.method.r);
    const BallStages stages(balls, ball_method, RealBall(1) / RealBall(8));
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(c.method.k, c.method.s, c.method.r);
    StageEquations<Mpfr> equations(scene.rounded.problem, method);
    const StageBox here = box_of(stages, scene.rounded, some_unknowns(equations, scene.rounded));
    // Each component is moved by a size of its own.
    RealBall small;
    arb_set_str(raw(small), "1e-25", 240);
    StageBox there = here, both = here;
    const auto move = [&](const BallMatrix& from, BallMatrix& to, BallMatrix& hull) {
      BallMatrix change(from.rows(), 1);
      for (Index i = 0; i < from.rows(); ++i) {
        change.set(i, 0, small * RealBall(static_cast<int>(i % 5) - 2));
        to.add(i, 0, change.at(i, 0));
        arb_union(hull(i, 0), from(i, 0), to(i, 0), 240);
      }
      return change;
    };
    const BallMatrix of_start = move(here.start, there.start, both.start),
                     of_unknowns = move(here.unknowns, there.unknowns, both.unknowns);
    const StageImage from = stages.image(here), to = stages.image(there);
    const StageDerivative d = stages.derivative(both);
    const auto expect_same = [&](const BallMatrix& difference, const BallMatrix& by_derivative) {
      for (Index i = 0; i < difference.rows(); ++i) {
        EXPECT_TRUE(arb_overlaps(difference(i, 0), by_derivative(i, 0)) != 0)
            << i << ": " << text_of(difference.at(i, 0)) << " and " << text_of(by_derivative.at(i, 0));
        EXPECT_LT(radius_of(by_derivative.at(i, 0)), 1e-44) << i;
        EXPECT_LT(radius_of(difference.at(i, 0)), 1e-44) << i;
      }
    };
    expect_same(to.residual - from.residual, d.by_unknowns * of_unknowns + d.by_start * of_start);
    expect_same(to.end - from.end, d.end_by_unknowns * of_unknowns + d.end_by_start * of_start);
  }
}

/// A solution with 80 digits the other way round is one of the step back, which leads to the start.
TEST(BallStages, MirroredUnknownsLeadBack) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.scene);
    const PrecisionScope digits(80);
    const ProvedScene scene(load_scene(c.scene));
    const BallProblem balls = scene.balls();
    const BallScope bits(300);
    const BallMethod ball_method = make_ball_method(c.method.k, c.method.s, c.method.r);
    const BallStages stages(balls, ball_method, RealBall(1) / RealBall(8));
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(c.method.k, c.method.s, c.method.r);
    const Index m = scene.rounded.problem.m();
    const Mpfr h = Mpfr(1) / 8;
    const auto solver = make_solver(SolverKind::automatic, scene.rounded.problem, method);
    // From a second step on, where the start has nothing special.
    Assembled<Mpfr> from = scene.rounded;
    for (int n = 0; n < 2; ++n) {
      solver->solve({from.q0, from.p0, h});
      if (n > 0) break;
      from.q0 += solver->change().q;
      from.p0 += solver->change().p;
    }
    const StageBox there = box_of(stages, from, solver->unknowns());
    StageBox back{stages.image(there).end, stages.mirrored(there.unknowns)};
    const auto turn = [&](BallMatrix& state) {
      for (Index j = m; j < 2 * m; ++j) state.set(j, 0, -state.at(j, 0));
    };
    turn(back.start);
    StageImage image = stages.image(back);
    turn(image.end);
    const auto expect_small = [](const BallMatrix& x) {
      for (Index i = 0; i < x.rows(); ++i)
        EXPECT_LT(centre_of(raw(greatest_magnitude(x.at(i, 0)))), 1e-70) << i << ": " << text_of(x.at(i, 0));
    };
    expect_small(stages.image(there).residual);
    expect_small(image.residual);
    expect_small(image.end - there.start);
  }
}

}  // namespace
}  // namespace hbvm::core
