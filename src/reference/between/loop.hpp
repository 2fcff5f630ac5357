#pragma once

#include <array>
#include <complex>
#include <functional>
#include <vector>

#include "ball.hpp"
#include "linear/index.hpp"

namespace hbvm::core {

/// What a polynomial in time is on a closed curve in complex time. The curve is a circle about a step's start, or an
/// ellipse about the step. Both are sums over an angle,
///
///     x(theta) = sum_n a_n exp(i n theta),  a_n real,
///
/// so that x is real at 0 and pi, and the lower half of the curve mirrors the upper. Sums and products of loops on one
/// curve are loops. Their terms cancel where those of balls cannot: of x^2 + y^2 on a circle in space hardly more than
/// a_0 is left.
class Loop {
 public:
  /// \param coefficients  a_first, a_{first+1}, …, each times 2^exponent; first is 0 or negative
  /// \param error  that each value may be off by, times 2^exponent, besides rounding of the coefficients
  Loop(std::vector<double> coefficients, long first, long exponent, double error = 0);
  /// A number, which does not vary.
  explicit Loop(const Mpfr& number);

  Loop operator+(const Loop& other) const;
  Loop operator-(const Loop& other) const { return *this + -other; }
  Loop operator*(const Loop& other) const;
  Loop operator-() const;

 private:
  friend class LoopEnclosure;
  bool is_zero() const;

  std::vector<double> coefficients_;
  long first_, exponent_;
  double error_;  ///< that each value is off by at most
};

/// Balls that hold a loop, arc by arc.
class LoopEnclosure {
 public:
  explicit LoopEnclosure(const Loop& loop);

  /// A ball that holds x on the arc of `half_width` radians to both sides of the angle with exp(i theta) = `at`. It is
  /// found by Taylor's formula about the middle. The remainder is what sum |a_n| |n|^d / d! bounds.
  void enclose(const std::complex<double>& at, double half_width, Ball& out) const;

 private:
  static constexpr std::size_t derivatives = 6;
  /// a_n n^d / d! for each d.
  using Weights = std::array<double, derivatives>;
  void add(double coefficient, double n, std::vector<Weights>& weights);

  std::vector<Weights> forward_, backward_;      ///< a_0, a_1, …; a_-1, a_-2, …
  std::array<double, derivatives + 1> sizes_{};  ///< sum |a_n| |n|^d / d!
  double roundings_, error_;
  long exponent_;
};

/// The circle about the start of a power series: a_n = x_n 2^(n log2_radius), the radius in the series' unit of time.
Loop circle_of(const std::function<const Mpfr&(Index)>& coefficient, Index order, double log2_radius);

/// The ellipse with the foci 0 and 1 and half axes that add up to rho/2: c = 1/2 + (w + 1/w)/4, w = rho exp(i theta),
/// of
///
///     x(c) = x_0 + sum_j y_j int_0^c P_j.
///
/// \param y the coefficients y_j in the orthonormal Legendre polynomials P_j
Loop ellipse_of(const Mpfr& x_0, const std::vector<Mpfr>& y, double log2_rho);

}  // namespace hbvm::core
