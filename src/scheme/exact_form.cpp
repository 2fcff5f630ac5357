#include "scheme/exact_form.hpp"

#include <flint/fmpz.h>
#include <flint/fmpz_lll.h>
#include <flint/fmpz_mat.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// c with c_2 x^2 + c_1 x + c_0 = 0, by a short vector of a lattice (A. Lenstra, H. Lenstra and L. Lovasz, 1982).
/// Nothing if the numbers are not small.
std::vector<long> quadratic_equation(const Mpfr& x, int digits) {
  fmpz_mat_t lattice;
  fmpz_mat_init(lattice, 3, 4);
  Mpfr power = pow(Mpfr(10), digits);
  for (int n = 0; n < 3; ++n) {
    fmpz_set_si(fmpz_mat_entry(lattice, n, n), 1);
    const std::string scaled = whole(floor(Mpfr(power + Mpfr(1) / 2)));
    fmpz_set_str(fmpz_mat_entry(lattice, n, 3), scaled.c_str(), 10);
    power *= x;
  }
  fmpz_lll_t context;
  fmpz_lll_context_init_default(context);
  fmpz_lll(lattice, nullptr, context);
  std::vector<long> c;
  double sizes = 0;
  for (int n = 0; n < 3; ++n) {
    const fmpz* const entry = fmpz_mat_entry(lattice, 0, n);
    if (!fmpz_fits_si(entry)) {
      fmpz_mat_clear(lattice);
      return {};
    }
    c.push_back(fmpz_get_si(entry));
    sizes += std::log10(std::max<double>(1, std::abs(static_cast<double>(c.back()))));
  }
  fmpz_mat_clear(lattice);
  constexpr long most = 100'000'000;  // whose squares are counted in a long
  const bool small = std::all_of(c.begin(), c.end(), [](long n) { return std::abs(n) < most; });
  return small && sizes + spare_digits <= digits && c[2] != 0 ? c : std::vector<long>();
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
