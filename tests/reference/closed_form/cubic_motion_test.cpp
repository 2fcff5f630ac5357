#include "reference/closed_form/cubic_motion.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

TEST(CubicRoots, AreThoseOfTheirPolynomial) {
  const PrecisionScope scope(50);
  for (const auto& roots :
       {std::array{"-1/2", "1/3", "2"}, std::array{"-5", "-1/7", "1e6"}, std::array{"-1/2", "-1/2", "3"},
        std::array{"-2", "1/3", "1/3"}, std::array{"0", "1e-9", "1"}}) {
    const Mpfr a = literal<Mpfr>(roots[0]), b = literal<Mpfr>(roots[1]), c = literal<Mpfr>(roots[2]);
    const CubicRoots found = CubicRoots::of(Mpfr(-(a + b + c)), Mpfr(a * b + a * c + b * c), Mpfr(-a * b * c));
    // What is a double root but for rounding is found to half the digits.
    const Mpfr tolerance = (a == b || b == c ? literal<Mpfr>("1e-24") : literal<Mpfr>("1e-38")) * (1 + abs(c));
    EXPECT_LE(magnitude(Mpfr(found.z1 - a)), tolerance);
    EXPECT_LE(magnitude(Mpfr(found.z2 - b)), tolerance);
    EXPECT_LE(magnitude(Mpfr(found.z3 - c)), tolerance);
  }
}

/// z' is the derivative, z'^2 the cubic, and the integrals have 1/(1 + z) and 1/(1 - z) as theirs: through several
/// turning points.
TEST(CubicMotion, FulfilsItsEquation) {
  const PrecisionScope scope(60);
  const Mpfr step = literal<Mpfr>("1e-15"), rough = literal<Mpfr>("1e-26");
  for (const auto& roots : {std::array{"-1/2", "1/3", "2"}, std::array{"-9/10", "-17/20", "1 + 1e-9"},
                            std::array{"-1 + 1e-4", "1 - 1e-3", "1 + 1e-4"}, std::array{"1/3", "1/3", "4"}}) {
    const CubicRoots r{literal<Mpfr>(roots[0]), literal<Mpfr>(roots[1]), literal<Mpfr>(roots[2])};
    const Mpfr f = literal<Mpfr>("7/3");
    for (const int sign : {1, -1}) {
      const Mpfr z = (2 * r.z1 + r.z2) / 3;
      const CubicMotion motion(r, f, z, Mpfr(sign));
      const CubicMotion::Place start = motion.at(Mpfr(0));
      EXPECT_LE(magnitude(Mpfr(start.z - z)), 100 * epsilon<Mpfr>());
      EXPECT_GE(start.rate * sign, 0);
      EXPECT_LE(magnitude(motion.integrals(Mpfr(0)).above), 1000 * epsilon<Mpfr>());
      for (const char* time : {"1/7", "3", "-10", "50"}) {
        const Mpfr t = literal<Mpfr>(time);
        const auto now = motion.at(t), before = motion.at(t - step), after = motion.at(t + step);
        const auto less = motion.integrals(t - step), more = motion.integrals(t + step);
        const Mpfr cubic = f * (now.z - r.z1) * (now.z - r.z2) * (now.z - r.z3);
        EXPECT_LE(magnitude(Mpfr(now.rate * now.rate - cubic)), literal<Mpfr>("1e-50"));
        EXPECT_LE(magnitude(Mpfr((after.z - before.z) / (2 * step) - now.rate)), rough) << time;
        EXPECT_LE(magnitude(Mpfr(now.above - 1 - now.z)), 100 * epsilon<Mpfr>());
        EXPECT_LE(magnitude(Mpfr(now.below - 1 + now.z)), 100 * epsilon<Mpfr>());
        // Their third derivatives grow like 1/(1 + z)^4.
        const Mpfr near = pow(Mpfr(std::min(now.above, now.below)), -4);
        EXPECT_LE(magnitude(Mpfr((more.above - less.above) / (2 * step) - 1 / now.above)), rough * near) << time;
        EXPECT_LE(magnitude(Mpfr((more.below - less.below) / (2 * step) - 1 / now.below)), rough * near) << time;
      }
    }
  }
}

}  // namespace
}  // namespace hbvm::core
