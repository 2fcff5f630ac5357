#include "reference/proof/error_growth.hpp"

#include <cmath>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

std::vector<RealBall> exactly_all(const Vector<Mpfr>& x) {
  std::vector<RealBall> result(static_cast<std::size_t>(x.size()));
  for (Index i = 0; i < x.size(); ++i) arf_set_mpfr(arb_midref(raw(result[static_cast<std::size_t>(i)])), raw(x[i]));
  return result;
}

/// M v' at a state.
Vector<Mpfr> pull(StateEvaluator<Mpfr>& point, const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
  const auto& forces = point.forces(q, p);
  return forces.applied + forces.constraint;
}

/// A and B are the derivatives of the force by position and velocity, against differences in 60 digits. With masses of
/// 1 there are no factors of M. Rods, surfaces by formulas and directors.
TEST(ErrorGrowth, HasTheDerivativesOfTheForce) {
  const PrecisionScope digits(60);
  const std::string two = body("a", "1", "[1, 0]", "[0, \"1/2\"]") + body("b", "1", "[1, 1]", "[\"1/4\", \"1/2\"]");
  const std::string rod = "[[constraint]]\nkind = \"rod\"\nbetween = [\"a\", \"b\"]\nlength = 1\n";
  const std::string curve = "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"x^4 + x*y^2 - 1\"\n";
  const std::string pull_of = formula("x*y^2 - x^4/4");
  for (const std::string& text :
       {two + pull_of, two + rod + pull_of, two + curve + pull_of, two + rod + curve + pull_of}) {
    const ProvedScene scene(read_scene("dimension = 2\n" + text, "growth"));
    const BallProblem balls = scene.balls();
    const BallScope bits(400);
    const ErrorGrowthIn growth_in(balls);
    const Vector<Mpfr>&q = scene.rounded.q0, &p = scene.rounded.p0;
    StateEvaluator<Mpfr> point(scene.rounded.problem);
    const PathBox at{exactly_all(q), exactly_all(p), exactly_all(pull(point, q, p))};
    const ErrorGrowth growth = growth_in(at, at, RealBall(0));
    const Mpfr h = 1 / Mpfr("1e20");
    RealBall error;
    arb_set_str(raw(error), "1e-35", 64);
    for (Index j = 0; j < q.size(); ++j) {
      Vector<Mpfr> to_q = q, from_q = q, to_p = p, from_p = p;
      to_q[j] += h;
      from_q[j] -= h;
      to_p[j] += h;
      from_p[j] -= h;
      const Vector<Mpfr> of_q = (pull(point, to_q, p) - pull(point, from_q, p)) / (2 * h);
      const Vector<Mpfr> of_p = (pull(point, q, to_p) - pull(point, q, from_p)) / (2 * h);
      for (Index i = 0; i < q.size(); ++i) {
        EXPECT_TRUE(holds(widened(growth.A.at(i, j), error), of_q[i]))
            << text << i << " " << j << ": " << text_of(growth.A.at(i, j)) << of_q[i];
        EXPECT_TRUE(holds(widened(growth.B.at(i, j), error), of_p[i])) << text << i << " " << j;
        EXPECT_LT(radius_of(growth.A.at(i, j)), 1e-40);
      }
    }
  }
}

/// On a piece of the path it holds what it is at each of its times, and is not much wider.
TEST(ErrorGrowth, HoldsAllOfAPiece) {
  const PrecisionScope digits(30);
  for (const char* name : {"double_pendulum", "heavy_top", "bead_on_torus", "kepler"}) {
    const ProvedScene scene(load_scene(name));
    const BallProblem balls = scene.balls();
    const BallScope bits(100);
    const ErrorGrowthIn growth_in(balls);
    const TaylorMotion motion(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0);
    const SeriesStep step = step_of(motion, balls);
    const auto box = [&](const RealBall& s) {
      return PathBox{step.positions(s), step.velocities(s), step.accelerations(s)};
    };
    const auto part_of_step = [&](int parts) {
      RealBall s;
      arb_get_mid_arb(raw(s), raw(step.end() * RealBall(parts) / RealBall(64)));
      return s;
    };
    RealBall piece;
    arb_union(raw(piece), raw(part_of_step(16)), raw(part_of_step(18)), 100);
    RealBall middle;
    arb_get_mid_arb(raw(middle), raw(piece));
    const ErrorGrowth all = growth_in(box(middle), box(piece), piece * step.unit());
    double rate = -1e300;
    for (int i = 16; i <= 18; ++i) {
      const RealBall s = part_of_step(i);
      const ErrorGrowth here = growth_in(box(s), box(s), s * step.unit());
      for (Index r = 0; r < all.A.rows(); ++r)
        for (Index c = 0; c < all.A.columns(); ++c) {
          EXPECT_TRUE(arb_overlaps(all.A(r, c), here.A(r, c)) != 0) << name;
          EXPECT_TRUE(arb_overlaps(all.B(r, c), here.B(r, c)) != 0) << name;
        }
      rate = std::max(rate, here.rate(2));
    }
    EXPECT_GE(all.rate(2), rate) << name;
    EXPECT_LT(all.rate(2), rate + 2 * std::abs(rate)) << name;
  }
}

BallMatrix matrix(const std::vector<std::vector<int>>& rows) {
  BallMatrix result(static_cast<Index>(rows.size()), static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      result.set(static_cast<Index>(i), static_cast<Index>(j), RealBall(rows[i][j]));
  return result;
}

/// Rates that are known. An oscillator's errors do not grow where they are measured by its own rate, free motion's grow
/// at omega / 2, and damping takes its part.
TEST(ErrorGrowth, HasKnownRates) {
  const BallMatrix zero = matrix({{0, 0}, {0, 0}});
  const auto rate = [&](const BallMatrix& A, const BallMatrix& B, double omega) {
    return ErrorGrowth{A, B, {}}.rate(omega);
  };
  EXPECT_GE(rate(matrix({{-9, 0}, {0, -9}}), zero, 3), 0);
  EXPECT_LT(rate(matrix({{-9, 0}, {0, -9}}), zero, 3), 1e-12);
  EXPECT_NEAR(rate(matrix({{-9, 0}, {0, -9}}), zero, 1), 4, 1e-12);
  EXPECT_NEAR(rate(zero, zero, 3), 1.5, 1e-12);
  EXPECT_NEAR(rate(matrix({{4, 0}, {0, 0}}), zero, 2), 2, 1e-12);
  // [[0, 0], [0, Y]] with the eigenvalues 1 and -5 of Y.
  EXPECT_NEAR(rate(matrix({{-1, 0}, {0, -1}}), matrix({{-2, 3}, {3, -2}}), 1), 1, 1e-12);
  // A skew part of B does nothing.
  EXPECT_LT(rate(matrix({{-1, 0}, {0, -1}}), matrix({{0, 7}, {-7, 0}}), 1), 1e-12);
  // What is wide adds as much as it may.
  BallMatrix wide = zero;
  mag_set_d(arb_radref(wide(0, 0)), 8);
  EXPECT_GE(rate(wide, zero, 2), 3);
  EXPECT_LT(rate(wide, zero, 2), 3.0001);
  arb_indeterminate(wide(1, 1));
  EXPECT_EQ(rate(wide, zero, 2), std::numeric_limits<double>::infinity());
}

/// How far an error of length 1 reaches, with uneven masses.
TEST(ErrorGrowth, MeasuresErrorsByTheMasses) {
  const PrecisionScope digits(30);
  const ProvedScene scene(read_scene(
      "dimension = 1\n" + body("a", "4", "[0]", "[0]") + body("b", "9", "[1]", "[0]") + formula("-x^2"), "masses"));
  const BallProblem balls = scene.balls();
  const BallScope bits(100);
  const ErrorGrowthIn growth_in(balls);
  const RealBall near = power_of_two_of(-40);
  EXPECT_TRUE(holds(widened(growth_in.velocity_reach(0), near), Mpfr(Mpfr(1) / 2)));
  EXPECT_TRUE(holds(widened(growth_in.momentum_reach(1), near), Mpfr(3)));
  // |e|^2 = 4 1^2 + 9 1^2 + 2^2 (4 3^2) = 157.
  const RealBall length = growth_in.length({RealBall(3), RealBall(0)}, {RealBall(1), RealBall(-1)}, RealBall(2));
  EXPECT_TRUE(holds(widened(length * length, near), Mpfr(157)));
}

/// Where the constraints' gradients may be dependent there is no multiplier, and no growth.
TEST(ErrorGrowth, IsRefusedWhereTheGramMatrixMayBeSingular) {
  const PrecisionScope digits(30);
  const ProvedScene scene(load_scene("simple_pendulum"));
  const BallProblem balls = scene.balls();
  const BallScope bits(100);
  const ErrorGrowthIn growth_in(balls);
  RealBall wide;
  mag_set_d(arb_radref(raw(wide)), 2);
  const PathBox box{{wide, wide}, {RealBall(0), RealBall(0)}, {RealBall(0), RealBall(0)}};
  EXPECT_THROW(growth_in(box, box, RealBall(0)), IntegrationError);
  EXPECT_THROW(growth_in.multipliers(box), IntegrationError);
}

}  // namespace
}  // namespace hbvm::core
