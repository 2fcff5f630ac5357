#pragma once

#include <array>
#include <complex>
#include <functional>
#include <vector>

#include "ball.hpp"

namespace hbvm {

/// What a polynomial in time is on a closed curve in complex time: on a circle about a step's start, or on an ellipse
/// about the step. Both are sums over an angle,
///
///     x(theta) = sum_n a_n exp(i n theta),  a_n real,
///
/// so that x is real at 0 and pi, and the lower half of the curve mirrors the upper.
class Loop {
 public:
  /// \param forward  a_0, a_1, …; backward: a_-1, a_-2, …; each a double times 2^exponent
  Loop(const std::vector<double>& forward, const std::vector<double>& backward, long exponent);

  /// A ball that holds x on the arc of `half_width` radians to both sides of the angle with exp(i theta) = `at`: by
  /// Taylor's formula about the middle, whose remainder sum |a_n| |n|^d / d! bounds.
  void enclose(const std::complex<double>& at, double half_width, Ball& out) const;

 private:
  static constexpr std::size_t derivatives = 6;
  /// a_n n^d / d! for each d.
  using Weights = std::array<double, derivatives>;
  void add(const std::vector<double>& coefficients, std::size_t first, std::vector<Weights>& weights);

  std::vector<Weights> forward_, backward_;
  std::array<double, derivatives + 1> sizes_{};  ///< sum |a_n| |n|^d / d!
  double roundings_;
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

}  // namespace hbvm
