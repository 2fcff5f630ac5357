#include "hbvm/reference/closed_form.hpp"

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "hbvm/problem/point.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scene/assemble.hpp"
#include "printing.hpp"

namespace hbvm {
namespace {

/// Arguments up to some 10 rounded to 60 digits have errors of 10 epsilon; a few operations follow.
Mpfr few_ulps() { return 100 * epsilon<Mpfr>(); }
void expect_near(const Mpfr& value, const Mpfr& expected, const Mpfr& tolerance, const std::string& what) {
  EXPECT_LE(magnitude(Mpfr(value - expected)), tolerance) << what << ": " << to_scientific(value, 40);
}

class Jacobi : public ::testing::Test {
 protected:
  PrecisionScope digits{60};
  const std::vector<Mpfr> arguments{Mpfr(0), literal<Mpfr>("1/7"), literal<Mpfr>("-3/5"),
                                    Mpfr(1), literal<Mpfr>("7/3"), Mpfr(10)};
  const std::vector<Mpfr> moduli{literal<Mpfr>("1e-20"), literal<Mpfr>("1/10"), literal<Mpfr>("1/2"),
                                 literal<Mpfr>("0.9")};
};

/// The mean converges in steps that double the digits: each number of digits tries its end anew.
TEST_F(Jacobi, HaveAllDigitsHoweverManyAreAsked) {
  for (unsigned n = 10; n <= 100; ++n) {
    const PrecisionScope few(n);
    const JacobiFunctions f = jacobi_functions(literal<Mpfr>("3/2"), literal<Mpfr>("1/2"));
    const Mpfr tolerance = few_ulps();
    const PrecisionScope many(130);
    const JacobiFunctions exact = jacobi_functions(literal<Mpfr>("3/2"), literal<Mpfr>("1/2"));
    expect_near(f.sn, exact.sn, tolerance, "sn in " + std::to_string(n) + " digits");
    expect_near(f.cn, exact.cn, tolerance, "cn in " + std::to_string(n) + " digits");
    expect_near(f.dn, exact.dn, tolerance, "dn in " + std::to_string(n) + " digits");
  }
}

TEST_F(Jacobi, AgreesWithBoost) {
  for (const Mpfr& u : arguments)
    for (const Mpfr& kappa : moduli) {
      const JacobiFunctions f = jacobi_functions(u, kappa);
      double cn = 0, dn = 0;
      const double sn = boost::math::jacobi_elliptic(approximately(kappa), approximately(u), &cn, &dn);
      // u is rounded, and Boost's own error is a few ulps.
      const double tolerance = 32 * epsilon<double>();
      EXPECT_NEAR(approximately(f.sn), sn, tolerance) << u << " " << kappa;
      EXPECT_NEAR(approximately(f.cn), cn, tolerance) << u << " " << kappa;
      EXPECT_NEAR(approximately(f.dn), dn, tolerance) << u << " " << kappa;
    }
}

TEST_F(Jacobi, SquaresSumToOne) {
  for (const Mpfr& u : arguments)
    for (const Mpfr& kappa : moduli) {
      const JacobiFunctions f = jacobi_functions(u, kappa);
      expect_near(f.sn * f.sn + f.cn * f.cn, Mpfr(1), few_ulps(), "sn^2 + cn^2");
      expect_near(f.dn * f.dn + kappa * kappa * f.sn * f.sn, Mpfr(1), few_ulps(), "dn^2 + kappa^2 sn^2");
    }
}

/// sn(u + v) = (sn u cn v dn v + sn v cn u dn u) / (1 - kappa^2 sn^2 u sn^2 v) and its like, Abramowitz and
/// Stegun 16.17.
TEST_F(Jacobi, FulfilAdditionTheorem) {
  for (const Mpfr& u : arguments)
    for (const Mpfr& v : arguments)
      for (const Mpfr& kappa : moduli) {
        const JacobiFunctions a = jacobi_functions(u, kappa), b = jacobi_functions(v, kappa),
                              sum = jacobi_functions(u + v, kappa);
        const Mpfr below = 1 - kappa * kappa * a.sn * a.sn * b.sn * b.sn;
        expect_near(sum.sn * below, a.sn * b.cn * b.dn + b.sn * a.cn * a.dn, few_ulps(), "sn");
        expect_near(sum.cn * below, a.cn * b.cn - a.sn * a.dn * b.sn * b.dn, few_ulps(), "cn");
        expect_near(sum.dn * below, a.dn * b.dn - kappa * kappa * a.sn * a.cn * b.sn * b.cn, few_ulps(), "dn");
      }
}

TEST_F(Jacobi, DerivativeOfSnIsCnDn) {
  const Mpfr step = literal<Mpfr>("1e-20");
  // The differences err by step^2 times third derivatives, which are below 10, and by round-off over the step.
  const Mpfr tolerance = 10 * step * step + few_ulps() / step;
  for (const Mpfr& u : arguments)
    for (const Mpfr& kappa : moduli) {
      const JacobiFunctions f = jacobi_functions(u, kappa), after = jacobi_functions(u + step, kappa),
                            before = jacobi_functions(u - step, kappa);
      expect_near((after.sn - before.sn) / (2 * step), f.cn * f.dn, tolerance, "sn'");
      expect_near((after.cn - before.cn) / (2 * step), -f.sn * f.dn, tolerance, "cn'");
      expect_near((after.dn - before.dn) / (2 * step), -kappa * kappa * f.sn * f.cn, tolerance, "dn'");
    }
}

TEST_F(Jacobi, ModulusZeroGivesCircularFunctions) {
  for (const Mpfr& u : arguments) {
    const JacobiFunctions f = jacobi_functions(u, Mpfr(0));
    EXPECT_EQ(f.sn, sin(u));
    EXPECT_EQ(f.cn, cos(u));
    EXPECT_EQ(f.dn, 1);
  }
}

/// For kappa -> 1 they are tanh and 1/cosh, up to (1 - kappa^2) cosh^2(u).
TEST_F(Jacobi, ModulusNearOneGivesHyperbolicFunctions) {
  const Mpfr small = literal<Mpfr>("1e-40"), kappa = 1 - small;
  for (const Mpfr& u : {literal<Mpfr>("1/7"), Mpfr(1), literal<Mpfr>("7/3")}) {
    const JacobiFunctions f = jacobi_functions(u, kappa);
    const Mpfr tolerance = small * cosh(u) * cosh(u);
    expect_near(f.sn, tanh(u), tolerance, "sn");
    expect_near(f.cn, 1 / cosh(u), tolerance, "cn");
    expect_near(f.dn, 1 / cosh(u), tolerance, "dn");
  }
}

TEST_F(Jacobi, DigitsAreThoseOfTheScope) {
  const PrecisionScope more(200);
  const JacobiFunctions f = jacobi_functions(Mpfr(1), Mpfr(1) / 2);
  const PrecisionScope fewer(60);
  const JacobiFunctions short_f = jacobi_functions(Mpfr(1), Mpfr(1) / 2);
  EXPECT_GT(mpfr_get_prec(raw(f.sn)), 600);
  EXPECT_LE(magnitude(Mpfr(f.sn - short_f.sn)), few_ulps());
}

class ClosedForm : public ::testing::TestWithParam<const char*> {
 protected:
  PrecisionScope digits{60};
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(GetParam()));
  const std::vector<Mpfr> times{Mpfr(0), literal<Mpfr>("1/3"), literal<Mpfr>("-5/2"), Mpfr(4), Mpfr(40)};
  /// 40 is the greatest argument.
  const Mpfr tolerance = 400 * epsilon<Mpfr>();

  static ExactPoint at(const Mpfr& t) {
    const auto point = closed_form(GetParam(), t);
    EXPECT_TRUE(point);
    return *point;
  }
};

TEST_P(ClosedForm, StartsWhereTheSceneDoes) {
  const ExactPoint start = at(Mpfr(0));
  EXPECT_LE(max_norm(Vector<Mpfr>(start.q - scene.q0)), epsilon<Mpfr>());
  EXPECT_LE(max_norm(Vector<Mpfr>(start.p - scene.p0)), epsilon<Mpfr>());
}

TEST_P(ClosedForm, StaysOnTheManifoldWithItsEnergy) {
  Point<Mpfr> point(scene.problem);
  const Mpfr H = point.energy(scene.q0, scene.p0);
  for (const Mpfr& t : times) {
    const ExactPoint now = at(t);
    EXPECT_LE(max_norm(point.constraints(now.q)), tolerance) << t;
    EXPECT_LE(max_norm(point.hidden_constraints(now.q, now.p)), tolerance) << t;
    EXPECT_LE(magnitude(Mpfr(point.energy(now.q, now.p) - H)), tolerance) << t;
  }
}

/// Both bobs have unit mass.
TEST_P(ClosedForm, MomentumIsTheDerivative) {
  const Mpfr step = literal<Mpfr>("1e-15");
  for (const Mpfr& t : times) {
    const ExactPoint before = at(t - step), now = at(t), after = at(t + step);
    // Third derivatives are below 10; round-off is divided by the step.
    const Mpfr allowed = 10 * step * step + tolerance / step;
    EXPECT_LE(max_norm(Vector<Mpfr>((after.q - before.q) / (2 * step) - now.p)), allowed) << t;
  }
}

/// p' is gravity, (0, -1) or (0, 0, -1), and the force of the rod, parallel to q.
TEST_P(ClosedForm, ForceIsGravityAndAlongTheRod) {
  const Mpfr step = literal<Mpfr>("1e-15");
  for (const Mpfr& t : times) {
    const ExactPoint before = at(t - step), now = at(t), after = at(t + step);
    const Mpfr allowed = 10 * step * step + tolerance / step;
    Vector<Mpfr> force = (after.p - before.p) / (2 * step);
    force[force.size() - 1] += 1;
    const Mpfr along = force.dot(now.q);
    EXPECT_LE(max_norm(Vector<Mpfr>(force - along * now.q)), allowed) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClosedForm, ::testing::Values("simple_pendulum", "conical_pendulum"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(ConicalPendulum, ReturnsAfterItsPeriodAndNotBefore) {
  const PrecisionScope digits(60);
  const Mpfr period = literal<Mpfr>("2^(3/4)*pi");
  const auto start = closed_form("conical_pendulum", Mpfr(0)), back = closed_form("conical_pendulum", period),
             half = closed_form("conical_pendulum", Mpfr(period / 2));
  ASSERT_TRUE(start && back && half);
  EXPECT_LE(max_norm(Vector<Mpfr>(back->q - start->q)), 100 * epsilon<Mpfr>());
  EXPECT_LE(max_norm(Vector<Mpfr>(back->p - start->p)), 100 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(half->q[0] + start->q[0])), 100 * epsilon<Mpfr>());
}

/// sin(theta/2) <= 1/2: it swings to 60 degrees.
TEST(SimplePendulum, TurnsAtSixtyDegrees) {
  const PrecisionScope digits(60);
  // K(1/2), of the arithmetic-geometric mean of 1 and sqrt(3)/2.
  Mpfr a = 1, b = literal<Mpfr>("sqrt(3)/2");
  for (int n = 0; n < 8; ++n) {
    const Mpfr mean = (a + b) / 2;
    b = sqrt(Mpfr(a * b));
    a = mean;
  }
  const auto turn = closed_form("simple_pendulum", Mpfr(literal<Mpfr>("pi/2") / a));
  ASSERT_TRUE(turn);
  EXPECT_LE(magnitude(Mpfr(turn->q[0] - literal<Mpfr>("sqrt(3)/2"))), 100 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(turn->q[1] + literal<Mpfr>("1/2"))), 100 * epsilon<Mpfr>());
  EXPECT_LE(max_norm(turn->p), 100 * epsilon<Mpfr>());
}

TEST(ClosedForms, AreOfTwoScenesOnly) {
  const PrecisionScope digits(30);
  int known = 0;
  for (const auto& [name, text] : built_in_scenes()) {
    EXPECT_EQ(closed_form(name, Mpfr(1)).has_value(), has_closed_form(name)) << name;
    known += has_closed_form(name);
  }
  EXPECT_EQ(known, 2);
  EXPECT_FALSE(closed_form("simple_pendulum.toml", Mpfr(1))) << "a file may hold another pendulum";
  EXPECT_FALSE(closed_form("", Mpfr(1)));
}

}  // namespace
}  // namespace hbvm
