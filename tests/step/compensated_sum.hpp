#pragma once

#include <cmath>

#include "linear/matrix.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

/// A body under a constant force that moves fast in one direction, so that many small steps add tiny equal parts to
/// large numbers.
inline const std::string falling = R"(dimension = 2
[[body]]
name = "a"
mass = 1
position = [1, -3]
velocity = [0.1, 100]
[[effect]]
kind = "uniform_gravity"
acceleration = ["1/3", "-1/7"]
)";
/// The same without the force.
inline const std::string floating = falling.substr(0, falling.find("[[effect]]"));

/// Sums of many equal increments, which plain additions get wrong.
class CompensatedSum : public InDigits<60> {
 protected:
  static constexpr int steps = 100'000;
  const double h = literal<double>("1e-7");

  /// x, to which `increment` was added `steps` times, and what it carries on; `rounding`: of the increment itself, in
  /// ulps of x over all steps.
  static void expect_exact_sum(double start, double increment, double x, double carry, double rounding = 0.001) {
    double naive = start;
    for (int n = 0; n < steps; ++n) naive += increment;
    const Mpfr exact = Mpfr(start) + Mpfr(increment) * steps;
    const double ulp = epsilon<double>() * std::abs(x);
    const auto ulps = [&](const Mpfr& miss) { return approximately(Mpfr(magnitude(miss) / Mpfr(ulp))); };
    EXPECT_GE(ulps(Mpfr(Mpfr(naive) - exact)), 50) << "the plain sum should be wrong";
    EXPECT_LE(ulps(Mpfr(Mpfr(x) - exact)), 1);
    EXPECT_LE(ulps(Mpfr(Mpfr(x) + Mpfr(carry) - exact)), rounding);
  }
};

}  // namespace hbvm::core
