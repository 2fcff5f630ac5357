#include "reference/between/loop.hpp"

#include <cmath>
#include <numbers>

#include "basis/legendre.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// Whether the ball holds the number, but for what double leaves of it.
bool holds(const Ball& ball, const std::complex<double>& z, double tolerance = 0) {
  Ball x;
  acb_set_d_d(raw(x), z.real(), z.imag());
  mag_t error;
  mag_init(error);
  mag_set_d(error, tolerance);
  acb_add_error_mag(raw(x), error);
  mag_clear(error);
  return acb_overlaps(raw(ball), raw(x)) != 0;
}

double radius(const Ball& ball) {
  Ball x = ball;
  mag_t size;
  mag_init(size);
  mag_hypot(size, arb_radref(acb_realref(raw(x))), arb_radref(acb_imagref(raw(x))));
  const double result = mag_get_d(size);
  mag_clear(size);
  return result;
}

Loop circle(const std::vector<Mpfr>& series, double log2_radius) {
  return circle_of([&series](Index n) -> const Mpfr& { return series[static_cast<std::size_t>(n)]; },
                   static_cast<Index>(series.size()) - 1, log2_radius);
}

Ball enclosed(const Loop& loop, const std::complex<double>& at, double half_width = 0) {
  Ball ball;
  LoopEnclosure(loop).enclose(at, half_width, ball);
  return ball;
}

/// exp on the circle of radius 3, from its series in a unit of 1/2. Each arc's ball holds the values on the arc, also
/// at its ends, and is not much wider than they are.
TEST(Loop, EnclosesASeriesOnACircle) {
  const PrecisionScope scope(40);
  constexpr Index order = 60;
  std::vector<Mpfr> series{Mpfr(1)};
  for (Index n = 1; n <= order; ++n) series.push_back(series.back() / (2 * n));
  const Loop loop = circle(series, std::log2(6.0));
  for (const double half : {0.2, 0.05, 0.001})
    for (double middle = half; middle < std::numbers::pi; middle += 0.3) {
      const Ball ball = enclosed(loop, std::polar(1.0, middle), half);
      double widest = 0;
      const std::complex<double> centre = std::exp(std::polar(3.0, middle));
      for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const std::complex<double> value = std::exp(std::polar(3.0, middle + part * half));
        EXPECT_TRUE(holds(ball, value, 1e-13 * std::abs(value))) << middle << " " << part;
        widest = std::max(widest, std::abs(value - centre));
      }
      EXPECT_LE(radius(ball), 4 * widest + 1e-12);
      EXPECT_FALSE(holds(ball, centre + 8 * widest + 1e-9));
    }
}

/// A polynomial in Legendre form on an ellipse. It is real beyond both ends of the step, where Legendre polynomials say
/// what it is. At w = i it has the value at 1/2 + i (rho - 1/rho)/4.
TEST(Loop, EnclosesAStepOnAnEllipse) {
  const PrecisionScope scope(40);
  const std::vector<Mpfr> y{literal<Mpfr>("3/2"), literal<Mpfr>("-1/3"), literal<Mpfr>("1/50"),
                            literal<Mpfr>("1/7000")};
  const Mpfr x_0 = literal<Mpfr>("-1/4");
  for (const double rho : {1.5, 8.0}) {
    const Loop loop = ellipse_of(x_0, y, std::log2(rho));
    const auto exact = [&](double sign) {
      const Vector<Mpfr> c = Vector<Mpfr>::Constant(1, Mpfr((2 + sign * (Mpfr(rho) + 1 / Mpfr(rho))) / 4));
      const Matrix<Mpfr> integrals = legendre_integrals<Mpfr>(c, 4);
      Mpfr x = x_0;
      for (Index j = 0; j < 4; ++j) x += y[static_cast<std::size_t>(j)] * integrals(0, j);
      return approximately(x);
    };
    for (const double sign : {1, -1}) {
      const Ball ball = enclosed(loop, sign);
      EXPECT_TRUE(holds(ball, exact(sign), sign > 0 ? 1e-13 : 1e-12)) << rho;
      EXPECT_FALSE(holds(ball, exact(sign) + 1e-9)) << rho;
    }
  }
  // int_0^c P_1 = sqrt 3 (c^2 - c).
  const double rho = 4, height = (rho - 1 / rho) / 4;
  const Loop loop = ellipse_of(Mpfr(0), {Mpfr(0), Mpfr(1)}, std::log2(rho));
  EXPECT_TRUE(holds(enclosed(loop, {0, 1}), -std::sqrt(3.0) * (height * height + 0.25), 1e-12));
}

/// Sums and products of loops hold those of the values. Of cos^2 + sin^2 on a wide circle hardly more than 1 is left,
/// though each square is some thousand: the terms cancel.
TEST(Loop, IsAddedAndMultiplied) {
  const PrecisionScope scope(40);
  constexpr Index order = 70;
  std::vector<Mpfr> cosine, sine;
  Mpfr term = 1;
  for (Index n = 0; n <= order; ++n) {
    cosine.push_back(n % 2 == 1 ? Mpfr(0) : n % 4 == 0 ? term : Mpfr(-term));
    sine.push_back(n % 2 == 0 ? Mpfr(0) : n % 4 == 1 ? term : Mpfr(-term));
    term /= n + 1;
  }
  const double radius_of_circle = 5;
  const double log2_radius = std::log2(radius_of_circle);
  const Loop c = circle(cosine, log2_radius), s = circle(sine, log2_radius), far(literal<Mpfr>("3*2^-80"));
  // Rounding of doubles beside the sum of the terms, e^5, and its square.
  const double rounding = 1e-11 * std::exp(radius_of_circle), of_squares = rounding * std::exp(radius_of_circle);
  for (const double angle : {0.0, 0.7, 1.6, 3.1}) {
    const std::complex<double> at = std::polar(1.0, angle), t = radius_of_circle * at;
    const auto expect = [&](const Loop& loop, const std::complex<double>& value, double widest) {
      const Ball ball = enclosed(loop, at);
      EXPECT_TRUE(holds(ball, value, 1e-13 * std::abs(value))) << angle << " " << value;
      EXPECT_LE(radius(ball), widest) << angle;
    };
    expect(c * c + s * s, 1, of_squares);
    expect(c * s, std::cos(t) * std::sin(t), of_squares);
    expect(c - s, std::cos(t) - std::sin(t), rounding);
    expect(-(c * Loop(Mpfr(3))), -3.0 * std::cos(t), rounding);
    expect(far + far * Loop(Mpfr(-1)) + far, std::ldexp(3.0, -80), 1e-36);
    expect(far + c, std::cos(t), rounding);
    expect(Loop(Mpfr(0)) + far, std::ldexp(3.0, -80), 1e-36);
    expect(Loop(Mpfr(0)) * c + far, std::ldexp(3.0, -80), 1e-36);
  }
  // Of two ellipses: x = c on both, its square is c^2.
  const double rho = 6;
  const Loop x = ellipse_of(literal<Mpfr>("0"), {Mpfr(1)}, std::log2(rho));
  const std::complex<double> w = std::polar(rho, 1.2), value = 0.5 + (w + 1.0 / w) / 4.0;
  const Ball ball = enclosed(x * x - x, std::polar(1.0, 1.2));
  EXPECT_TRUE(holds(ball, value * value - value, 1e-13));
  EXPECT_LE(radius(ball), 1e-12);
}

/// Numbers beyond the range of double are enclosed, too.
TEST(Loop, HasAnyExponent) {
  const PrecisionScope scope(40);
  const std::vector<Mpfr> series{literal<Mpfr>("2^-5000"), literal<Mpfr>("2^-5001")};
  Ball ball = enclosed(circle(series, 1), 1);
  acb_mul_2exp_si(raw(ball), raw(ball), 5000);
  EXPECT_TRUE(holds(ball, 2));
  EXPECT_FALSE(holds(ball, 2.001));
}

}  // namespace
}  // namespace hbvm::core
