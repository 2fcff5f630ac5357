#include "scheme/exact_form.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

constexpr int spare_digits = 6;  ///< that a chance number would have to agree in

std::string whole(const Mpfr& x) { return x.str(0, std::ios_base::fixed); }

/// By its continued fraction.
std::string fraction(const Mpfr& x, int digits) {
  const Mpfr unit = pow(Mpfr(10), -digits);
  Mpfr rest = x, p = 1, q = 0, p_before = 0, q_before = 1;
  for (int n = 0; n < digits * 4; ++n) {
    const Mpfr a = floor(rest), p_next = a * p + p_before, q_next = a * q + q_before;
    p_before = p;
    q_before = q;
    p = p_next;
    q = q_next;
    if (magnitude(Mpfr(p * q)) * pow(Mpfr(10), spare_digits) * unit > 1) return {};
    if (magnitude(Mpfr(p / q - x)) <= unit * std::max(Mpfr(1), magnitude(x)))
      return whole(p) + (q == 1 ? "" : "/" + whole(q));
    if (rest == a) return {};
    rest = 1 / (rest - a);
  }
  return {};
}

/// c with c_2 x^2 + c_1 x + c_0 = 0 and the smallest c_2 up to 1000. Nothing if there is none that x shows by its
/// digits.
std::vector<long> quadratic_equation(const Mpfr& x, int digits) {
  constexpr long most = 1'000;
  constexpr long largest = 100'000;  // whose squares are counted in a long
  const double near = approximately(x), unclear = epsilon<double>() * most * 1'000 * (1 + near * near);
  const Mpfr unit = pow(Mpfr(10), -digits);
  if (!(std::abs(near) <= static_cast<double>(largest))) return {};
  for (long square = 1; square <= most; ++square)
    for (long linear = -2 * most; linear <= 2 * most; ++linear) {
      const double sum = (static_cast<double>(square) * near + static_cast<double>(linear)) * near;
      if (std::abs(sum - std::round(sum)) > unclear) continue;
      const long constant = -std::lround(sum);
      double size = 0;
      for (const long c : {square, linear, constant})
        size += std::log10(std::max<double>(1, std::abs(static_cast<double>(c))));
      const Mpfr off = (square * x + linear) * x + constant;
      if (size + spare_digits <= digits && magnitude(off) <= most * unit) return {constant, linear, square};
    }
  return {};
}

std::string with_root(const Mpfr& x, int digits) {
  const std::vector<long> c = quadratic_equation(x, digits);
  if (c.empty()) return {};
  long radicand = c[1] * c[1] - 4 * c[2] * c[0], factor = 1;
  if (radicand <= 0) return {};
  for (long n = 2; n * n <= radicand && n < 1'000'000; ++n)
    while (radicand % (n * n) == 0) {
      radicand /= n * n;
      factor *= n;
    }
  if (radicand == 1) return {};
  long below = 2 * c[2], first = -c[1];
  if (below < 0) {
    below = -below;
    first = -first;
  }
  const long common = std::gcd(std::gcd(below, first), factor);
  below /= common;
  first /= common;
  factor /= common;
  const Mpfr root = sqrt(Mpfr(radicand)) * factor;
  const bool plus = magnitude(Mpfr((first + root) / below - x)) < magnitude(Mpfr((first - root) / below - x));
  std::string text = first == 0 ? (plus ? "" : "-") : std::to_string(first) + (plus ? " + " : " - ");
  text += (factor == 1 ? "" : std::to_string(factor) + "*") + "sqrt(" + std::to_string(radicand) + ")";
  if (below == 1) return text;
  return (first == 0 ? text : "(" + text + ")") + "/" + std::to_string(below);
}

}  // namespace

std::string exact_form(const Mpfr& x, int digits) {
  if (x == 0) return "0";
  const std::string simple = fraction(x, digits);
  return simple.empty() ? with_root(x, digits) : simple;
}

}  // namespace hbvm::core
