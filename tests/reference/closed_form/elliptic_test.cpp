#include "reference/closed_form/elliptic.hpp"

#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// Arguments up to some 10 rounded to 60 digits have errors of 10 epsilon; a few operations follow.
Mpfr few_ulps() { return 100 * epsilon<Mpfr>(); }
void expect_near(const Mpfr& value, const Mpfr& expected, const Mpfr& tolerance, const std::string& what) {
  EXPECT_LE(magnitude(Mpfr(value - expected)), tolerance) << what << ": " << to_scientific(value, 40);
}

JacobiFunctions jacobi(const Mpfr& u, const Mpfr& kappa) {
  const Mpfr m = kappa * kappa;
  return jacobi_functions(u, m, Mpfr(1 - m));
}

class Jacobi : public InDigits<60> {
 protected:
  const std::vector<Mpfr> arguments{Mpfr(0), literal<Mpfr>("1/7"), literal<Mpfr>("-3/5"),
                                    Mpfr(1), literal<Mpfr>("7/3"), Mpfr(10)};
  const std::vector<Mpfr> moduli{literal<Mpfr>("1e-20"), literal<Mpfr>("1/10"), literal<Mpfr>("1/2"),
                                 literal<Mpfr>("0.9")};
};

/// The mean converges in steps that double the digits: each number of digits tries its end anew.
TEST_F(Jacobi, HaveAllDigitsHoweverManyAreAsked) {
  for (unsigned n = 10; n <= 100; ++n) {
    const PrecisionScope few(n);
    const JacobiFunctions f = jacobi(literal<Mpfr>("3/2"), literal<Mpfr>("1/2"));
    const Mpfr tolerance = few_ulps();
    const PrecisionScope many(130);
    const JacobiFunctions exact = jacobi(literal<Mpfr>("3/2"), literal<Mpfr>("1/2"));
    expect_near(f.sn, exact.sn, tolerance, "sn in " + std::to_string(n) + " digits");
    expect_near(f.cn, exact.cn, tolerance, "cn in " + std::to_string(n) + " digits");
    expect_near(f.dn, exact.dn, tolerance, "dn in " + std::to_string(n) + " digits");
  }
}

TEST_F(Jacobi, AgreesWithBoost) {
  for (const Mpfr& u : arguments)
    for (const Mpfr& kappa : moduli) {
      const JacobiFunctions f = jacobi(u, kappa);
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
      const JacobiFunctions f = jacobi(u, kappa);
      expect_near(f.sn * f.sn + f.cn * f.cn, Mpfr(1), few_ulps(), "sn^2 + cn^2");
      expect_near(f.dn * f.dn + kappa * kappa * f.sn * f.sn, Mpfr(1), few_ulps(), "dn^2 + kappa^2 sn^2");
    }
}

/// sn(u + v) = (sn u cn v dn v + sn v cn u dn u) / (1 - kappa^2 sn^2 u sn^2 v) and its like. See Abramowitz and Stegun
/// 16.17.
TEST_F(Jacobi, FulfilAdditionTheorem) {
  for (const Mpfr& u : arguments)
    for (const Mpfr& v : arguments)
      for (const Mpfr& kappa : moduli) {
        const JacobiFunctions a = jacobi(u, kappa), b = jacobi(v, kappa), sum = jacobi(u + v, kappa);
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
      const JacobiFunctions f = jacobi(u, kappa), after = jacobi(u + step, kappa), before = jacobi(u - step, kappa);
      expect_near((after.sn - before.sn) / (2 * step), f.cn * f.dn, tolerance, "sn'");
      expect_near((after.cn - before.cn) / (2 * step), -f.sn * f.dn, tolerance, "cn'");
      expect_near((after.dn - before.dn) / (2 * step), -kappa * kappa * f.sn * f.cn, tolerance, "dn'");
    }
}

TEST_F(Jacobi, ModulusZeroGivesCircularFunctions) {
  for (const Mpfr& u : arguments) {
    const JacobiFunctions f = jacobi(u, Mpfr(0));
    EXPECT_EQ(f.sn, sin(u));
    EXPECT_EQ(f.cn, cos(u));
    EXPECT_EQ(f.dn, 1);
  }
}

/// For kappa -> 1 they are tanh and 1/cosh, up to (1 - kappa^2) cosh^2(u).
TEST_F(Jacobi, ModulusNearOneGivesHyperbolicFunctions) {
  const Mpfr small = literal<Mpfr>("1e-40"), kappa = 1 - small;
  for (const Mpfr& u : {literal<Mpfr>("1/7"), Mpfr(1), literal<Mpfr>("7/3")}) {
    const JacobiFunctions f = jacobi(u, kappa);
    const Mpfr tolerance = small * cosh(u) * cosh(u);
    expect_near(f.sn, tanh(u), tolerance, "sn");
    expect_near(f.cn, 1 / cosh(u), tolerance, "cn");
    expect_near(f.dn, 1 / cosh(u), tolerance, "dn");
  }
}

TEST_F(Jacobi, DigitsAreThoseOfTheScope) {
  const PrecisionScope more(200);
  const JacobiFunctions f = jacobi(Mpfr(1), Mpfr(1) / 2);
  const PrecisionScope fewer(60);
  const JacobiFunctions short_f = jacobi(Mpfr(1), Mpfr(1) / 2);
  EXPECT_GT(mpfr_get_prec(raw(f.sn)), 600);
  EXPECT_LE(magnitude(Mpfr(f.sn - short_f.sn)), few_ulps());
}

/// The greater modulus: kappa sn, kappa cn and dn go over into one another, and the equations stay.
TEST_F(Jacobi, ModulusAboveOne) {
  const Mpfr step = literal<Mpfr>("1e-20"), tolerance = 100 * step * step + few_ulps() / step;
  for (const Mpfr& u : arguments)
    for (const char* kappa : {"1.0000001", "3/2", "20"}) {
      const Mpfr k = literal<Mpfr>(kappa);
      if (k * k > 100 && u > 1) continue;  // whose rounding counts 20 times
      const JacobiFunctions f = jacobi(u, k), after = jacobi(u + step, k), before = jacobi(u - step, k);
      expect_near(f.sn * f.sn + f.cn * f.cn, Mpfr(1), few_ulps(), "sn^2 + cn^2");
      expect_near(f.dn * f.dn + k * k * f.sn * f.sn, Mpfr(1), 10 * few_ulps(), "dn^2 + kappa^2 sn^2");
      expect_near((after.sn - before.sn) / (2 * step), f.cn * f.dn, tolerance * k * k * k, "sn'");
    }
}

TEST_F(Jacobi, AmplitudeGrowsWithItsArgument) {
  const Mpfr pi = 4 * atan(Mpfr(1));
  for (const Mpfr& kappa : moduli) {
    const Mpfr m = kappa * kappa, m1 = 1 - m, quarter = elliptic_first(Mpfr(pi / 2), m1);
    for (const Mpfr& u : arguments) {
      const Mpfr phi = jacobi_amplitude(u, m, m1);
      expect_near(sin(phi), jacobi(u, kappa).sn, few_ulps(), "sin am");
      expect_near(jacobi_amplitude(Mpfr(u + 2 * quarter), m, m1), phi + pi, 10 * few_ulps(), "am(u + 2 K)");
      if (abs(phi) <= pi / 2) expect_near(elliptic_first(phi, m1), u, few_ulps(), "F(am u)");
    }
    // K by the arithmetic-geometric mean.
    Mpfr a = 1, b = sqrt(m1);
    for (int n = 0; n < 10; ++n) {
      const Mpfr mean = (a + b) / 2;
      b = sqrt(Mpfr(a * b));
      a = mean;
    }
    expect_near(quarter, pi / (2 * a), few_ulps(), "K");
  }
}

/// Boost has them in double. In all digits the duplication theorem, by which they were not computed last, holds for any
/// arguments. R_F(x) is homogeneous of degree -1/2, R_J of degree -3/2, and R_J(x, x, x, x) = x^(-3/2).
TEST_F(Jacobi, CarlsonsIntegrals) {
  const char* const arguments_of[][4] = {{"1", "2", "3", "4"},
                                         {"0", "1", "2", "1e-3"},
                                         {"1/7", "5", "1e6", "100"},
                                         {"2", "2", "2", "2"},
                                         {"1", "1", "0", "7"}};
  for (const auto& texts : arguments_of) {
    const Mpfr x = literal<Mpfr>(texts[0]), y = literal<Mpfr>(texts[1]), z = literal<Mpfr>(texts[2]),
               p = literal<Mpfr>(texts[3]);
    const double tolerance = 64 * epsilon<double>();
    const double rf = boost::math::ellint_rf(approximately(x), approximately(y), approximately(z)),
                 rj = boost::math::ellint_rj(approximately(x), approximately(y), approximately(z), approximately(p));
    EXPECT_NEAR(approximately(carlson_rf(x, y, z)), rf, tolerance * rf);
    EXPECT_NEAR(approximately(carlson_rj(x, y, z, p)), rj, tolerance * rj);
    const Mpfr F = carlson_rf(x, y, z), J = carlson_rj(x, y, z, p);
    expect_near(carlson_rf(Mpfr(3 * z), Mpfr(3 * x), Mpfr(3 * y)), F / sqrt(Mpfr(3)), few_ulps() * F, "R_F scaled");
    expect_near(carlson_rj(Mpfr(3 * z), Mpfr(3 * x), Mpfr(3 * y), Mpfr(3 * p)), J / (3 * sqrt(Mpfr(3))), few_ulps() * J,
                "R_J scaled");
  }
  expect_near(carlson_rj(Mpfr(4), Mpfr(4), Mpfr(4), Mpfr(4)), Mpfr(1) / 8, few_ulps(), "R_J(4, 4, 4, 4)");
  // The lemniscate constant, and R_J(0, 1, 1, 1) = 3 pi/4.
  const Mpfr pi = 4 * atan(Mpfr(1));
  expect_near(carlson_rj(Mpfr(0), Mpfr(1), Mpfr(1), Mpfr(1)), 3 * pi / 4, few_ulps(), "R_J(0, 1, 1, 1)");
}

/// Twice the digits, or ten times, tell the same.
TEST_F(Jacobi, CarlsonsIntegralsHaveAllDigits) {
  for (const unsigned n : {15U, 40U, 77U, 200U, 1000U}) {
    const auto integral = [] {
      return carlson_rj(literal<Mpfr>("1/7"), Mpfr(5), literal<Mpfr>("22/7"), literal<Mpfr>("1/100"));
    };
    const PrecisionScope few(n);
    const Mpfr found = integral(), tolerance = few_ulps();
    const PrecisionScope many(n + 30);
    const Mpfr exact = integral();
    EXPECT_LE(magnitude(Mpfr(found - exact)), tolerance * exact) << n;
  }
}

/// int_0^u n sn^2/(1 - n sn^2): its derivative, at amplitudes beyond a turn, too.
TEST_F(Jacobi, IntegralOfTheThirdKind) {
  const Mpfr step = literal<Mpfr>("1e-15");
  for (const Mpfr& kappa : moduli)
    for (const char* text : {"1/3", "0", "-5", "-1000", "0.99"}) {
      const Mpfr n = literal<Mpfr>(text), m = kappa * kappa, m1 = 1 - m;
      const EllipticThird third(n, Mpfr(1 - n), m1);
      EXPECT_EQ(third.at(Mpfr(0)), 0);
      for (const char* angle : {"1/5", "3/2", "8/5", "10", "-31"}) {
        const Mpfr phi = literal<Mpfr>(angle), s2 = sin(phi) * sin(phi);
        const Mpfr expected = n * s2 / ((1 - n * s2) * sqrt(Mpfr(1 - m * s2)));
        expect_near((third.at(Mpfr(phi + step)) - third.at(Mpfr(phi - step))) / (2 * step), expected,
                    literal<Mpfr>("1e-20"), text + std::string(" at ") + angle);
      }
    }
}

TEST_F(Jacobi, AdvanceByTheAdditionTheorem) {
  for (const char* text : {"0", "1/2", "0.999", "1", "1.2", "7"}) {
    const Mpfr k = literal<Mpfr>(text), m = k * k, m1 = 1 - m;
    const auto multiples = [&](const Mpfr& u) {
      const JacobiFunctions f = jacobi_functions(u, m, m1);
      return JacobiMultiples{k * f.sn, k * f.cn, f.dn};
    };
    for (const char* u : {"1/3", "2"}) {
      const JacobiMultiples found = advanced(multiples(literal<Mpfr>("2/7")), m, m1, literal<Mpfr>(u)),
                            exact = multiples(literal<Mpfr>("2/7") + literal<Mpfr>(u));
      expect_near(found.kappa_sn, exact.kappa_sn, 100 * few_ulps(), "kappa sn");
      expect_near(found.kappa_cn, exact.kappa_cn, 100 * few_ulps(), "kappa cn");
      expect_near(found.dn, exact.dn, 100 * few_ulps(), "dn");
    }
  }
}

/// Where an integral is infinite, and where the modulus is so near 1 that no rounding of it shows that.
TEST_F(Jacobi, ModulusOneHasNoQuarterPeriod) {
  const Mpfr half = 2 * atan(Mpfr(1));
  EXPECT_THROW(carlson_rf(Mpfr(0), Mpfr(0), Mpfr(1)), IntegrationError);
  EXPECT_THROW(carlson_rf(Mpfr(1), Mpfr(0), Mpfr(0)), IntegrationError);
  EXPECT_THROW(carlson_rj(Mpfr(0), Mpfr(0), Mpfr(1), Mpfr(2)), IntegrationError);
  EXPECT_THROW(carlson_rj(Mpfr(0), Mpfr(1), Mpfr(1), Mpfr(0)), IntegrationError);
  // K = log(4/kappa') and nothing more that counts.
  for (const char* text : {"1e-100", "1e-1000"}) {
    const Mpfr m1 = literal<Mpfr>(text);
    expect_near(carlson_rf(Mpfr(0), m1, Mpfr(1)), log(4 / sqrt(m1)), 1000 * few_ulps(), text);
  }
  // The amplitude comes as near to pi/2 as rounding has it, and no further.
  for (const char* text : {"1", "100", "1000", "1e6"}) {
    const Mpfr u = literal<Mpfr>(text);
    EXPECT_LE(jacobi_amplitude(u, Mpfr(1), Mpfr(0)), half + few_ulps()) << text;
    const EllipticThird third(Mpfr(-3), Mpfr(4), Mpfr(0));
    EXPECT_LT(third.at(jacobi_amplitude(u, Mpfr(1), Mpfr(0))), 0) << text;
    EXPECT_GT(third.at(jacobi_amplitude(Mpfr(-u), Mpfr(1), Mpfr(0))), 0) << text;
  }
}

TEST(Stumpff, AreTheirSeriesAndTheirFunctions) {
  const PrecisionScope digits(60);
  for (const char* text : {"0", "1e-30", "1", "1.0001", "-1", "-1.0001", "40", "-40"}) {
    const Mpfr x = literal<Mpfr>(text);
    const StumpffFunctions f = stumpff_functions(x);
    const Mpfr found[] = {f.c0, f.c1, f.c2, f.c3};
    // (-x)^j / (k + 2 j)!
    for (int k = 0; k < 4; ++k) {
      Mpfr term = 1, sum = 0;
      for (int i = 2; i <= k; ++i) term /= i;
      for (int j = 0; j < 80; ++j) {
        sum += term;
        term *= -x / ((k + 2 * j + 1) * (k + 2 * j + 2));
      }
      expect_near(found[k], sum, 1000 * few_ulps(), "c_" + std::to_string(k));
    }
  }
}

}  // namespace
}  // namespace hbvm::core
