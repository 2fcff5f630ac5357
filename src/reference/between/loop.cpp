#include "loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm::core {

namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();

double size_of(const std::vector<double>& coefficients) {
  double size = 0;
  for (const double x : coefficients) size += std::abs(x);
  return size;
}

}  // namespace

Loop::Loop(std::vector<double> coefficients, long first, long exponent, double error)
    : coefficients_(std::move(coefficients)), first_(first), exponent_(exponent) {
  // Each coefficient is some operations on doubles.
  const double roundings = static_cast<double>(16 * coefficients_.size()) * round_off, size = size_of(coefficients_);
  error_ = size == 0 && error == 0 ? 0 : error + roundings * size + std::numeric_limits<double>::min();
}

Loop::Loop(const Mpfr& number) : first_(0), exponent_(0) {
  coefficients_.push_back(mpfr_get_d_2exp(&exponent_, raw(number), MPFR_RNDN));
  error_ = round_off * std::abs(coefficients_[0]);
}

bool Loop::is_zero() const { return error_ == 0 && size_of(coefficients_) == 0; }

Loop Loop::operator+(const Loop& other) const {
  if (is_zero()) return other;
  if (other.is_zero()) return *this;
  if (other.exponent_ > exponent_) return other + *this;
  // What is far below the greater one goes into the error.
  const double scale = std::ldexp(double{1}, static_cast<int>(std::max(other.exponent_ - exponent_, long{-1100})));
  const long first = std::min(first_, other.first_);
  const auto here = static_cast<std::size_t>(first_ - first), there = static_cast<std::size_t>(other.first_ - first);
  std::vector<double> sum(std::max(here + coefficients_.size(), there + other.coefficients_.size()));
  std::copy(coefficients_.begin(), coefficients_.end(), sum.begin() + static_cast<std::ptrdiff_t>(here));
  for (std::size_t n = 0; n < other.coefficients_.size(); ++n) sum[there + n] += scale * other.coefficients_[n];
  const double tiny = static_cast<double>(sum.size()) * std::numeric_limits<double>::min();
  const double size = size_of(coefficients_) + scale * size_of(other.coefficients_);
  return {std::move(sum), first, exponent_, error_ + scale * other.error_ + round_off * size + tiny};
}

Loop Loop::operator*(const Loop& other) const {
  const std::vector<double>&a = coefficients_, &b = other.coefficients_;
  std::vector<double> product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  const double size = size_of(a), other_size = size_of(b);
  const double roundings = static_cast<double>(std::min(a.size(), b.size()) + 2) * round_off;
  const double error = (error_ + roundings * size) * other_size + (size + error_) * other.error_;
  const double tiny = is_zero() || other.is_zero() ? 0 : std::numeric_limits<double>::min();
  return {std::move(product), first_ + other.first_, exponent_ + other.exponent_,
          error + static_cast<double>(a.size() * b.size()) * tiny};
}

Loop Loop::operator-() const {
  Loop negative = *this;
  for (double& x : negative.coefficients_) x = -x;
  return negative;
}

LoopEnclosure::LoopEnclosure(const Loop& loop)
    : roundings_(static_cast<double>(16 * (loop.coefficients_.size() + derivatives))),
      error_(loop.error_),
      exponent_(loop.exponent_) {
  const auto zero = static_cast<std::size_t>(-loop.first_);
  for (std::size_t i = zero; i < loop.coefficients_.size(); ++i)
    add(loop.coefficients_[i], static_cast<double>(i - zero), forward_);
  for (std::size_t i = zero; i-- > 0;) add(loop.coefficients_[i], static_cast<double>(zero - i), backward_);
}

void LoopEnclosure::add(double coefficient, double n, std::vector<Weights>& weights) {
  Weights& of_n = weights.emplace_back();
  double term = coefficient;
  for (std::size_t d = 0; d < sizes_.size(); ++d) {
    if (d < derivatives) of_n[d] = term;
    sizes_[d] += std::abs(term);
    term *= n / static_cast<double>(d + 1);
  }
}

void LoopEnclosure::enclose(const std::complex<double>& at, double half_width, Ball& out) const {
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
  radius += roundings_ * round_off * rounding + error_;
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
  return {a.fractions, 0, a.exponent};
}

Loop ellipse_of(const Mpfr& x_0, const std::vector<Mpfr>& y, double log2_rho) {
  // x_0 comes first, so that all have one power of two.
  const Scaled all = scaled([&](Index n) -> const Mpfr& { return n == 0 ? x_0 : y[static_cast<std::size_t>(n - 1)]; },
                            static_cast<Index>(y.size()) + 1, 0);
  const std::size_t s = y.size();
  // int_0^c P_j = xi_{j+1} P_{j+1} - xi_j P_{j-1}, int_0^c P_0 = 1/2 + xi_1 P_1; P_j by its norm.
  const auto xi = [](std::size_t j) { return 1 / (2 * std::sqrt(static_cast<double>(4 * j * j - 1))); };
  // Sums, and those of magnitudes, beside which sums are rounded.
  std::vector<double> legendre(s + 1), sizes(s + 1);
  const auto add = [&](std::size_t j, double term) {
    legendre[j] += term;
    sizes[j] += std::abs(term);
  };
  add(0, all.fractions[0]);
  add(0, all.fractions[1] / 2);
  for (std::size_t j = 0; j < s; ++j) {
    const double y_j = all.fractions[j + 1];
    add(j + 1, xi(j + 1) * y_j);
    if (j > 0) add(j - 1, -xi(j) * y_j);
  }
  const std::vector<double> a = cosine_weights(s + 1);
  std::vector<double> coefficients(2 * s + 1);
  double greatest = 0;
  for (std::size_t n = 0; n <= s; ++n) {
    double sum = 0, size = 0;
    for (std::size_t j = n; j <= s; j += 2) {
      const double weight = std::sqrt(static_cast<double>(2 * j + 1)) * a[(j - n) / 2] * a[(j + n) / 2];
      sum += legendre[j] * weight;
      size += sizes[j] * weight;
    }
    const double power = static_cast<double>(n) * log2_rho;
    coefficients[s + n] = sum * std::exp2(power);
    if (n > 0) coefficients[s - n] = sum * std::exp2(-power);
    greatest += 2 * size * std::exp2(power);
  }
  const double roundings = static_cast<double>(16 * s) * round_off;
  return {coefficients, -static_cast<long>(s), all.exponent, roundings * greatest};
}

}  // namespace hbvm::core
