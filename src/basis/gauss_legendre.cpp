#include "basis/gauss_legendre.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "hbvm/error.hpp"

namespace hbvm::core {
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
    // c = ((1 - x) - delta)/2
    mpfr_ui_sub(raw(c), 1, raw(x_), MPFR_RNDN);
    mpfr_sub(raw(c), raw(c), raw(delta_), MPFR_RNDN);
    mpfr_div_2ui(raw(c), raw(c), 1, MPFR_RNDN);
    square_complement();
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
      mpfr_div_ui(raw(u_), raw(u_), static_cast<unsigned long>(j) + 1, MPFR_RNDN);
      mpfr_swap(raw(previous_), raw(p_));
      mpfr_add(raw(p_), raw(t_), raw(u_), MPFR_RNDN);
    }
  }

  /// Taylor coefficients a_j of P_n at x. The first are a_0 = P_n, (1 - x^2) a_1 = n (P_{n-1} - x P_n). The others
  /// follow from (1 - x^2) P'' - 2 x P' + n (n+1) P = 0:
  ///     (j+1)(j+2)(1 - x^2) a_{j+2} = 2 (j+1)^2 x a_{j+1} + (j (j+1) - n (n+1)) a_j.
  /// Each is computed to the digits that a_j delta^j needs beside a_1 delta; stops where that needs none, and returns
  /// the number of coefficients.
  std::size_t expand() {
    mpfr_set_prec(raw(t_), bits_);
    mpfr_set_prec(raw(u_), bits_);
    mpfr_set(raw(coefficient(0, bits_)), raw(p_), MPFR_RNDN);
    BigFloat& first = coefficient(1, bits_);
    mpfr_mul(raw(t_), raw(x_), raw(p_), MPFR_RNDN);
    mpfr_sub(raw(t_), raw(previous_), raw(t_), MPFR_RNDN);
    mpfr_mul_ui(raw(t_), raw(t_), static_cast<unsigned long>(n_), MPFR_RNDN);
    mpfr_div(raw(first), raw(t_), raw(one_minus_x2_), MPFR_RNDN);
    mpfr_div(raw(delta_), raw(p_), raw(first), MPFR_RNDN);
    mpfr_neg(raw(delta_), raw(delta_), MPFR_RNDN);
    if (mpfr_zero_p(raw(delta_))) return 2;
    const long delta_exponent = mpfr_get_exp(raw(delta_)) + 1;
    const long largest = mpfr_get_exp(raw(first));
    const long nn = static_cast<long>(n_) * (n_ + 1);
    for (std::size_t j = 0;; ++j) {
      const long i = static_cast<long>(j);
      // Compared with the slope a_1, the term j + 1 of the series' derivative is what decides.
      const BigFloat& last = series_[j + 1];
      const long term = mpfr_zero_p(raw(last)) ? -bits_ : mpfr_get_exp(raw(last)) - largest + i * delta_exponent;
      const long bits = bits_ + std::min(0L, term) + static_cast<long>(std::bit_width(j + 2));
      if ((j > 0 && bits <= 0) || i + 2 > n_) return j + 2;
      const long needed = std::clamp(bits + guard, 64L, bits_);
      BigFloat& next = coefficient(j + 2, needed);
      mpfr_set_prec(raw(t_), needed);
      mpfr_set_prec(raw(u_), needed);
      mpfr_mul(raw(t_), raw(series_[j + 1]), raw(x_), MPFR_RNDN);
      mpfr_mul_si(raw(t_), raw(t_), 2 * (i + 1) * (i + 1), MPFR_RNDN);
      mpfr_mul_si(raw(u_), raw(series_[j]), i * (i + 1) - nn, MPFR_RNDN);
      mpfr_add(raw(t_), raw(t_), raw(u_), MPFR_RNDN);
      mpfr_div_si(raw(t_), raw(t_), (i + 1) * (i + 2), MPFR_RNDN);
      mpfr_div(raw(next), raw(t_), raw(one_minus_x2_), MPFR_RNDN);
    }
  }

  /// P_n and P_n' at x + delta, into t_ and slope_, to so many bits of the slope.
  void sum(std::size_t terms, long bits) {
    mpfr_set_prec(raw(t_), 64);
    mpfr_set_prec(raw(slope_), 64);
    mpfr_set_zero(raw(t_), 1);
    mpfr_set_zero(raw(slope_), 1);
    for (std::size_t j = terms; j-- > 0;) {
      const long needed = std::min<long>(mpfr_get_prec(raw(series_[j])) + (j == 0 ? guard : 0), bits);
      // From term to term more digits count.
      if (needed > mpfr_get_prec(raw(t_))) {
        mpfr_prec_round(raw(t_), needed, MPFR_RNDN);
        mpfr_prec_round(raw(slope_), needed, MPFR_RNDN);
        mpfr_set_prec(raw(u_), needed);
        mpfr_set(raw(u_), raw(delta_), MPFR_RNDN);
      } else if (j + 1 == terms) {
        mpfr_set_prec(raw(u_), 64);
        mpfr_set(raw(u_), raw(delta_), MPFR_RNDN);
      }
      mpfr_mul(raw(slope_), raw(slope_), raw(u_), MPFR_RNDN);
      mpfr_add(raw(slope_), raw(slope_), raw(t_), MPFR_RNDN);
      mpfr_mul(raw(t_), raw(t_), raw(u_), MPFR_RNDN);
      mpfr_add(raw(t_), raw(t_), raw(series_[j]), MPFR_RNDN);
    }
  }

  /// Newton's method for the root delta_ of the series, which leaves its derivative there in slope_. Each sweep doubles
  /// the digits and takes no more than it wins.
  void solve(std::size_t terms) {
    if (mpfr_zero_p(raw(delta_))) {
      mpfr_set_prec(raw(slope_), bits_);
      mpfr_set(raw(slope_), raw(series_[1]), MPFR_RNDN);
      return;
    }
    // A sweep takes 2^-e to 2^-2e but for a few bits; the first delta, -a_0/a_1, has some 40.
    constexpr long known = 24, lost = 8;
    std::vector<long> wanted{bits_};
    while (wanted.back() > 2 * known - lost) wanted.push_back(wanted.back() / 2 + lost);
    for (std::size_t sweep = wanted.size(); sweep-- > 0;) {
      sum(terms, std::min(wanted[sweep] + guard, bits_));
      mpfr_div(raw(t_), raw(t_), raw(slope_), MPFR_RNDN);
      mpfr_sub(raw(delta_), raw(delta_), raw(t_), MPFR_RNDN);
    }
    // The slope at the new delta, t_ = P/P' away: P' - t P'' with (1 - x^2) P'' = 2 x P' - n (n+1) P. What is left out
    // is of the order of t^2, below round-off.
    mpfr_set_prec(raw(u_), bits_);
    mpfr_mul_ui(raw(u_), raw(t_), static_cast<unsigned long>(n_) * static_cast<unsigned long>(n_ + 1), MPFR_RNDN);
    mpfr_set_prec(raw(p_), bits_);
    mpfr_add(raw(p_), raw(x_), raw(delta_), MPFR_RNDN);
    mpfr_mul_2ui(raw(p_), raw(p_), 1, MPFR_RNDN);
    mpfr_sub(raw(u_), raw(p_), raw(u_), MPFR_RNDN);
    mpfr_mul(raw(u_), raw(u_), raw(t_), MPFR_RNDN);
    mpfr_set_prec(raw(t_), bits_);
    square_complement();
    mpfr_div(raw(u_), raw(u_), raw(t_), MPFR_RNDN);
    mpfr_ui_sub(raw(u_), 1, raw(u_), MPFR_RNDN);
    mpfr_mul(raw(slope_), raw(slope_), raw(u_), MPFR_RNDN);
  }

  /// t_ = 1 - (x + delta)^2 = (1 - x^2) - delta (2 x + delta).
  void square_complement() {
    mpfr_mul_2ui(raw(t_), raw(x_), 1, MPFR_RNDN);
    mpfr_add(raw(t_), raw(t_), raw(delta_), MPFR_RNDN);
    mpfr_mul(raw(t_), raw(t_), raw(delta_), MPFR_RNDN);
    mpfr_sub(raw(t_), raw(one_minus_x2_), raw(t_), MPFR_RNDN);
  }

  /// b = 1 / ((1 - x^2) P_n'(x)^2), the weight for [0, 1], from t_ = 1 - x^2 and slope_.
  void weight(BigFloat& b) {
    mpfr_sqr(raw(u_), raw(slope_), MPFR_RNDN);
    mpfr_mul(raw(t_), raw(t_), raw(u_), MPFR_RNDN);
    mpfr_ui_div(raw(b), 1, raw(t_), MPFR_RNDN);
  }

  BigFloat& coefficient(std::size_t j, long bits) {
    while (series_.size() <= j) series_.emplace_back(bits_);
    mpfr_set_prec(raw(series_[j]), bits);
    return series_[j];
  }

  /// Bits beyond those wanted, for the roundings of a sum.
  static constexpr long guard = 32;

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
  // The recurrence loses up to n ulps, 1 - x and 1 - x^2 near 1 another factor of n^2. The 32 bits beyond that make it
  // unlikely that a number so near the middle of two is met that it goes the wrong way. With 2 bits none is up to n =
  // 100.
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

}  // namespace hbvm::core
