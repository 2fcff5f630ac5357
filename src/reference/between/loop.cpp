#include "loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm {

Loop::Loop(const std::vector<double>& forward, const std::vector<double>& backward, long exponent)
    : roundings_(static_cast<double>(16 * (forward.size() + backward.size() + derivatives))), exponent_(exponent) {
  add(forward, 0, forward_);
  add(backward, 1, backward_);
}

void Loop::add(const std::vector<double>& coefficients, std::size_t first, std::vector<Weights>& weights) {
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const auto n = static_cast<double>(i + first);
    Weights& of_n = weights.emplace_back();
    double term = coefficients[i];
    for (std::size_t d = 0; d < sizes_.size(); ++d) {
      if (d < derivatives) of_n[d] = term;
      sizes_[d] += std::abs(term);
      term *= n / static_cast<double>(d + 1);
    }
  }
}

void Loop::enclose(const std::complex<double>& at, double half_width, Ball& out) const {
  std::array<std::complex<double>, derivatives> sums{};
  // Horner's scheme in z, for the value and its derivatives side by side.
  const auto add = [&](const std::vector<Weights>& weights, const std::complex<double>& z, bool backward) {
    Weights real{}, imaginary{};
    const double x = z.real(), y = z.imag();
    for (std::size_t i = weights.size(); i-- > 0;)
      for (std::size_t d = 0; d < derivatives; ++d) {
        const double next = real[d] * x - imaginary[d] * y + weights[i][d];
        imaginary[d] = real[d] * y + imaginary[d] * x;
        real[d] = next;
      }
    for (std::size_t d = 0; d < derivatives; ++d) {
      std::complex<double> sum(real[d], imaginary[d]);
      if (backward) sum *= d % 2 == 0 ? z : -z;  // (-n)^d
      sums[d] += sum;
    }
  };
  add(forward_, at, false);
  if (!backward_.empty()) add(backward_, std::conj(at), true);
  double radius = 0, rounding = sizes_[0], power = 1;
  for (std::size_t d = 1; d < sizes_.size(); ++d) {
    power *= half_width;
    radius += power * (d < derivatives ? std::abs(sums[d]) : sizes_[d]);
    rounding += power * sizes_[d];
  }
  radius += roundings_ * std::numeric_limits<double>::epsilon() * rounding + std::numeric_limits<double>::min();
  acb_set_d_d(raw(out), sums[0].real(), sums[0].imag());
  mag_t size;
  mag_init(size);
  mag_set_d(size, radius);
  acb_add_error_mag(raw(out), size);
  mag_clear(size);
  acb_mul_2exp_si(raw(out), raw(out), exponent_);
}

namespace {

/// Numbers as doubles times one power of two.
struct Scaled {
  std::vector<double> fractions;
  long exponent;
};

/// x_n 2^(n shift).
Scaled scaled(const std::function<const Mpfr&(Index)>& x, Index count, double shift) {
  Scaled result;
  std::vector<double> exponents;
  double greatest = -std::numeric_limits<double>::infinity();
  for (Index n = 0; n < count; ++n) {
    long exponent = 0;
    result.fractions.push_back(mpfr_get_d_2exp(&exponent, raw(x(n)), MPFR_RNDN));
    exponents.push_back(static_cast<double>(exponent) + static_cast<double>(n) * shift);
    if (result.fractions.back() != 0) greatest = std::max(greatest, exponents.back());
  }
  const double unit = std::isinf(greatest) ? 0 : std::ceil(greatest);
  for (std::size_t n = 0; n < result.fractions.size(); ++n)
    if (result.fractions[n] != 0) result.fractions[n] *= std::exp2(exponents[n] - unit);
  result.exponent = static_cast<long>(unit);
  return result;
}

/// Of P_n(cos phi) = sum_l a_l a_{n-l} cos((n - 2 l) phi): (2l)! / (4^l l!^2).
std::vector<double> cosine_weights(std::size_t count) {
  std::vector<double> a(count, 1);
  for (std::size_t l = 1; l < count; ++l) a[l] = a[l - 1] * static_cast<double>(2 * l - 1) / static_cast<double>(2 * l);
  return a;
}

}  // namespace

Loop circle_of(const std::function<const Mpfr&(Index)>& coefficient, Index order, double log2_radius) {
  const Scaled a = scaled(coefficient, order + 1, log2_radius);
  return {a.fractions, {}, a.exponent};
}

Loop ellipse_of(const Mpfr& x_0, const std::vector<Mpfr>& y, double log2_rho) {
  // x_0 comes first, so that all have one power of two.
  const Scaled all = scaled([&](Index n) -> const Mpfr& { return n == 0 ? x_0 : y[static_cast<std::size_t>(n - 1)]; },
                            static_cast<Index>(y.size()) + 1, 0);
  const std::size_t s = y.size();
  // int_0^c P_j = xi_{j+1} P_{j+1} - xi_j P_{j-1}, int_0^c P_0 = 1/2 + xi_1 P_1; P_j by its norm.
  const auto xi = [](std::size_t j) { return 1 / (2 * std::sqrt(static_cast<double>(4 * j * j - 1))); };
  std::vector<double> legendre(s + 1);
  legendre[0] = all.fractions[0] + all.fractions[1] / 2;
  for (std::size_t j = 0; j < s; ++j) {
    const double y_j = all.fractions[j + 1];
    legendre[j + 1] += xi(j + 1) * y_j;
    if (j > 0) legendre[j - 1] -= xi(j) * y_j;
  }
  for (std::size_t j = 0; j <= s; ++j) legendre[j] *= std::sqrt(static_cast<double>(2 * j + 1));
  const std::vector<double> a = cosine_weights(s + 1);
  std::vector<double> forward(s + 1), backward(s);
  for (std::size_t n = 0; n <= s; ++n) {
    double sum = 0;
    for (std::size_t j = n; j <= s; j += 2) sum += legendre[j] * a[(j - n) / 2] * a[(j + n) / 2];
    const double power = static_cast<double>(n) * log2_rho;
    forward[n] = sum * std::exp2(power);
    if (n > 0) backward[n - 1] = sum * std::exp2(-power);
  }
  return {forward, backward, all.exponent};
}

}  // namespace hbvm
