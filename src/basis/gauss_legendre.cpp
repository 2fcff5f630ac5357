#include "hbvm/basis/gauss_legendre.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "hbvm/error.hpp"

namespace hbvm {
namespace {

/// The k-th root of the Legendre polynomial of degree n, counted from 1 downwards, to nearly double precision.
double root_in_double(int n, int k) {
  double x = std::cos(std::numbers::pi * (4 * k - 1) / (4 * n + 2));
  for (int sweep = 0; sweep < 8; ++sweep) {
    double previous = 1, value = x;
    for (int j = 1; j < n; ++j) {
      const double next = ((2 * j + 1) * x * value - j * previous) / (j + 1);
      previous = value;
      value = next;
    }
    const double step = value * (1 - x * x) / (n * (previous - x * value));
    x -= step;
    if (std::abs(step) < 8 * std::numeric_limits<double>::epsilon() * (1 - x)) break;
  }
  return x;
}

/// Working storage and the steps of the computation at `bits` significand bits.
class LegendreRoots {
 public:
  LegendreRoots(int n, long bits)
      : n_(n),
        bits_(bits),
        x_(53),
        one_minus_x2_(106 + 32),
        p_(bits),
        previous_(bits),
        t_(bits),
        u_(bits),
        delta_(bits),
        slope_(bits) {}

  /// c = (1 - x)/2 and its weight for the k-th root x.
  void compute(int k, BigFloat& c, BigFloat& b) {
    const double start = root_in_double(n_, k);
    mpfr_set_d(raw(x_), start, MPFR_RNDN);
    // Exact: x^2 has 106 bits, and 1 - x^2 another 28 at most, as |x| > 1/n.
    mpfr_sqr(raw(one_minus_x2_), raw(x_), MPFR_RNDN);
    mpfr_ui_sub(raw(one_minus_x2_), 1, raw(one_minus_x2_), MPFR_RNDN);
    evaluate();
    const std::size_t terms = expand();
    solve(terms);
    // c = ((1 - x) - delta)/2 and 1 - (x + delta)^2 = (1 - x^2) - delta (2 x + delta)
    mpfr_ui_sub(raw(c), 1, raw(x_), MPFR_RNDN);
    mpfr_sub(raw(c), raw(c), raw(delta_), MPFR_RNDN);
    mpfr_div_2ui(raw(c), raw(c), 1, MPFR_RNDN);
    mpfr_mul_2ui(raw(t_), raw(x_), 1, MPFR_RNDN);
    mpfr_add(raw(t_), raw(t_), raw(delta_), MPFR_RNDN);
    mpfr_mul(raw(t_), raw(t_), raw(delta_), MPFR_RNDN);
    mpfr_sub(raw(t_), raw(one_minus_x2_), raw(t_), MPFR_RNDN);
    weight(b);
  }

  /// The root x = 0 of an odd polynomial.
  void compute_middle(BigFloat& c, BigFloat& b) {
    mpfr_set_d(raw(x_), 0, MPFR_RNDN);
    evaluate();
    mpfr_mul_ui(raw(slope_), raw(previous_), static_cast<unsigned long>(n_), MPFR_RNDN);
    mpfr_set_ui(raw(t_), 1, MPFR_RNDN);
    weight(b);
    mpfr_set_ui_2exp(raw(c), 1, -1, MPFR_RNDN);
  }

 private:
  /// p_ = P_n(x), previous_ = P_{n-1}(x) by (j+1) P_{j+1} = (2j+1) x P_j - j P_{j-1}, in the form
  /// P_{j+1} = x P_j + (x P_j - P_{j-1}) j/(j+1).
  void evaluate() {
    mpfr_set_ui(raw(previous_), 1, MPFR_RNDN);
    mpfr_set(raw(p_), raw(x_), MPFR_RNDN);
    for (int j = 1; j < n_; ++j) {
      mpfr_mul(raw(t_), raw(p_), raw(x_), MPFR_RNDN);
      mpfr_sub(raw(u_), raw(t_), raw(previous_), MPFR_RNDN);
      mpfr_mul_ui(raw(u_), raw(u_), static_cast<unsigned long>(j), MPFR_RNDN);
      mpfr_div_ui(raw(u_), raw(u_), static_cast<unsigned long>(j + 1), MPFR_RNDN);
      mpfr_swap(raw(previous_), raw(p_));
      mpfr_add(raw(p_), raw(t_), raw(u_), MPFR_RNDN);
    }
  }

  /// Taylor coefficients a_j of P_n at x: a_0 = P_n, (1 - x^2) a_1 = n (P_{n-1} - x P_n), and from
  /// (1 - x^2) P'' - 2 x P' + n (n+1) P = 0
  ///   (j+1)(j+2)(1 - x^2) a_{j+2} = 2 (j+1)^2 x a_{j+1} + (j (j+1) - n (n+1)) a_j.
  /// Stops where a_j delta^j no longer matters; returns the number of coefficients.
  std::size_t expand() {
    mpfr_set(raw(coefficient(0)), raw(p_), MPFR_RNDN);
    BigFloat& first = coefficient(1);
    mpfr_mul(raw(t_), raw(x_), raw(p_), MPFR_RNDN);
    mpfr_sub(raw(t_), raw(previous_), raw(t_), MPFR_RNDN);
    mpfr_mul_ui(raw(t_), raw(t_), static_cast<unsigned long>(n_), MPFR_RNDN);
    mpfr_div(raw(first), raw(t_), raw(one_minus_x2_), MPFR_RNDN);
    mpfr_div(raw(delta_), raw(p_), raw(first), MPFR_RNDN);
    mpfr_neg(raw(delta_), raw(delta_), MPFR_RNDN);
    if (mpfr_zero_p(raw(delta_))) return 2;
    const long delta_exponent = mpfr_get_exp(raw(delta_)) + 1;
    const long smallest = mpfr_get_exp(raw(first)) - bits_;
    const long nn = static_cast<long>(n_) * (n_ + 1);
    for (std::size_t j = 0;; ++j) {
      const long i = static_cast<long>(j);
      BigFloat& next = coefficient(j + 2);
      mpfr_mul(raw(t_), raw(coefficient(j + 1)), raw(x_), MPFR_RNDN);
      mpfr_mul_si(raw(t_), raw(t_), 2 * (i + 1) * (i + 1), MPFR_RNDN);
      mpfr_mul_si(raw(u_), raw(coefficient(j)), i * (i + 1) - nn, MPFR_RNDN);
      mpfr_add(raw(t_), raw(t_), raw(u_), MPFR_RNDN);
      mpfr_div_si(raw(t_), raw(t_), (i + 1) * (i + 2), MPFR_RNDN);
      mpfr_div(raw(next), raw(t_), raw(one_minus_x2_), MPFR_RNDN);
      // Compared with the slope a_1, the term j + 2 of the series' derivative is what decides.
      if (mpfr_zero_p(raw(next)) ||
          mpfr_get_exp(raw(next)) + (i + 1) * delta_exponent + static_cast<long>(std::bit_width(j + 2)) < smallest)
        return j + 3;
    }
  }

  /// Newton's method for the root delta_ of the series, which leaves its derivative there in slope_.
  void solve(std::size_t terms) {
    long last = 0;
    for (int sweep = 0; sweep < 64; ++sweep) {
      mpfr_set(raw(t_), raw(coefficient(terms - 1)), MPFR_RNDN);
      mpfr_set_zero(raw(slope_), 1);
      for (std::size_t j = terms - 1; j-- > 0;) {
        mpfr_mul(raw(slope_), raw(slope_), raw(delta_), MPFR_RNDN);
        mpfr_add(raw(slope_), raw(slope_), raw(t_), MPFR_RNDN);
        mpfr_mul(raw(t_), raw(t_), raw(delta_), MPFR_RNDN);
        mpfr_add(raw(t_), raw(t_), raw(coefficient(j)), MPFR_RNDN);
      }
      mpfr_div(raw(t_), raw(t_), raw(slope_), MPFR_RNDN);
      if (mpfr_zero_p(raw(t_))) return;
      const long step = mpfr_get_exp(raw(t_));
      if (sweep > 0 && step >= last) return;  // round-off
      last = step;
      mpfr_sub(raw(delta_), raw(delta_), raw(t_), MPFR_RNDN);
    }
  }

  /// b = 1 / ((1 - x^2) P_n'(x)^2), the weight for [0, 1], from t_ = 1 - x^2 and slope_.
  void weight(BigFloat& b) {
    mpfr_sqr(raw(u_), raw(slope_), MPFR_RNDN);
    mpfr_mul(raw(t_), raw(t_), raw(u_), MPFR_RNDN);
    mpfr_ui_div(raw(b), 1, raw(t_), MPFR_RNDN);
  }

  BigFloat& coefficient(std::size_t j) {
    while (series_.size() <= j) series_.emplace_back(bits_);
    return series_[j];
  }

  int n_;
  long bits_;
  BigFloat x_, one_minus_x2_, p_, previous_, t_, u_, delta_, slope_;
  std::vector<BigFloat> series_;
};

}  // namespace

template <Scalar S>
Quadrature<S> gauss_legendre(int n) {
  if (n < 1 || n > max_quadrature_nodes)
    throw InputError("Gauss-Legendre nodes: n = " + std::to_string(n) + " is not between 1 and " +
                     std::to_string(max_quadrature_nodes));
  // The recurrence loses up to n ulps, 1 - x and 1 - x^2 near 1 another factor of n^2.
  const long bits = significand_bits<S>() + 32 + 4L * std::bit_width(static_cast<unsigned>(n));
  LegendreRoots roots(n, bits);
  Quadrature<S> formula{Vector<S>(n), Vector<S>(n)};
  BigFloat c(bits), b(bits);
  const S one = 1;
  for (int k = 1; 2 * k <= n; ++k) {
    roots.compute(k, c, b);
    formula.c[k - 1] = rounded_to<S>(raw(c));
    formula.b[k - 1] = rounded_to<S>(raw(b));
    formula.c[n - k] = one - formula.c[k - 1];
    formula.b[n - k] = formula.b[k - 1];
  }
  if (n % 2 == 1) {
    roots.compute_middle(c, b);
    formula.c[n / 2] = rounded_to<S>(raw(c));
    formula.b[n / 2] = rounded_to<S>(raw(b));
  }
  return formula;
}

#define HBVM_DEFINE(S) template Quadrature<S> gauss_legendre<S>(int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
