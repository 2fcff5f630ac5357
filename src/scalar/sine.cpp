#include "scalar/sine.hpp"

#include <gmp.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scalar/big_float.hpp"

namespace hbvm::core {
namespace {

// Numbers here are fractions of 1, n limbs with the least first. What is cut off below the last limb is a few units
// each time, and less than 2^bits_lost of them all together. These are four of the series, and twice those of its parts
// and five more for each level of the table.
using Limbs = std::vector<mp_limb_t>;
constexpr long limb_bits = GMP_NUMB_BITS;
constexpr long bits_lost = 8;
constexpr long most_limbs = 12;  // with more the series needs so many terms that mpfr_sin is as quick

/// The limbs of 0 <= a < 2^limb_bits: n behind the point and one before it.
Limbs limbs_of(mpfr_ptr a, long n) {
  mpz_t whole;
  mpz_init(whole);
  mpfr_mul_2si(a, a, limb_bits * n, MPFR_RNDN);
  mpfr_get_z(whole, a, MPFR_RNDD);
  mpfr_mul_2si(a, a, -limb_bits * n, MPFR_RNDN);
  Limbs limbs;
  for (long i = 0; i <= n; ++i) limbs.push_back(mpz_getlimbn(whole, i));
  mpz_clear(whole);
  return limbs;
}

/// What evaluations start from. An angle below 1 is k 2^-7 + l 2^-14 and a rest. k and l are below 2^7, and of the rest
/// a few terms of the series are enough. The table has the sine and the versine 1 - cos of the angles k 2^-7 and l
/// 2^-14, with most_limbs each. Shorter numbers are the upper limbs of these.
class SineTable {
 public:
  static constexpr int levels = 2, step_bits = 7, steps = 1 << step_bits, rest_bits = levels * step_bits;

  SineTable() {
    const mpfr_prec_t precision = limb_bits * (most_limbs + 2);
    BigFloat a(precision), sine(precision), cosine(precision), x(precision), y(precision), t(precision);
    mpfr_const_pi(raw(a), MPFR_RNDN);
    mpfr_div_2ui(raw(a), raw(a), 1, MPFR_RNDN);
    quarter_in_double_ = mpfr_get_d(raw(a), MPFR_RNDN);
    quarter_ = limbs_of(raw(a), most_limbs + 1);
    for (int level = 1; level <= levels; ++level) {
      mpfr_set_ui_2exp(raw(a), 1, -level * step_bits, MPFR_RNDN);
      mpfr_sin_cos(raw(sine), raw(cosine), raw(a), MPFR_RNDN);
      // One angle after another, by the addition theorems.
      mpfr_set_ui(raw(x), 0, MPFR_RNDN);
      mpfr_set_ui(raw(y), 1, MPFR_RNDN);
      for (int k = 0; k < steps; ++k) {
        append(entries_, raw(x));
        mpfr_ui_sub(raw(t), 1, raw(y), MPFR_RNDN);
        append(entries_, raw(t));
        mpfr_fmms(raw(t), raw(y), raw(cosine), raw(x), raw(sine), MPFR_RNDN);
        mpfr_fmma(raw(x), raw(x), raw(cosine), raw(y), raw(sine), MPFR_RNDN);
        mpfr_swap(raw(y), raw(t));
      }
    }
    mpfr_set_ui(raw(a), 1, MPFR_RNDN);
    long last = 1;
    for (long n = 1; n <= most_limbs; ++n) {
      while (last == 1 || mpfr_get_exp(raw(a)) - last * rest_bits > -limb_bits * n) {
        last += 2;
        mpfr_div_ui(raw(a), raw(a), static_cast<unsigned long>((last - 1) * last), MPFR_RNDN);
        append(factorials_, raw(a));
      }
      last_.push_back(last);
    }
  }

  /// pi/2, n + 1 limbs behind the point and one before it.
  const mp_limb_t* quarter(long n) const { return quarter_.data() + most_limbs - n; }
  double quarter_in_double() const { return quarter_in_double_; }
  const mp_limb_t* sine(long n, int level, mp_limb_t k) const { return entry(n, level, 2 * k); }
  const mp_limb_t* versine(long n, int level, mp_limb_t k) const { return entry(n, level, 2 * k + 1); }
  /// 1/j! for odd j, from 3 to the last that counts.
  const mp_limb_t* factorial(long n, long j) const {
    return factorials_.data() + (j - 3) / 2 * most_limbs + most_limbs - n;
  }
  long last(long n) const { return last_[static_cast<std::size_t>(n - 1)]; }

 private:
  static void append(Limbs& to, mpfr_ptr a) {
    const Limbs limbs = limbs_of(a, most_limbs);
    to.insert(to.end(), limbs.begin(), limbs.end() - 1);
  }
  const mp_limb_t* entry(long n, int level, mp_limb_t which) const {
    return entries_.data() + (2 * (level - 1) * steps + static_cast<long>(which)) * most_limbs + most_limbs - n;
  }

  double quarter_in_double_ = 0;
  Limbs quarter_, entries_, factorials_;
  std::vector<long> last_;
};

class SineEvaluation {
 public:
  SineEvaluation() : room_(8 * most_limbs + 8), result_(limb_bits * most_limbs) {}

  static long limbs_for(mpfr_srcptr r) {
    // With bits_lost of them a rounding is not known once in a thousand times.
    constexpr long guard_bits = 18;
    return (mpfr_get_prec(r) + guard_bits) / limb_bits + 1;
  }

  /// r = sin(a + turn pi/2) for a turn of 0 or 1, unless its last bit is not known.
  bool evaluate(mpfr_ptr r, mpfr_srcptr a, unsigned turn) {
    n_ = limbs_for(r);
    const unsigned long quarters = reduce(a) + turn;
    const bool is_cosine = quarters % 2 == 1;
    expand(is_cosine);
    mp_limb_t* const value = is_cosine ? versine() : sine();
    if (is_cosine) mpn_neg(value, value, n_);
    const mpz_t z = MPZ_ROINIT_N(value, static_cast<int>(n_));
    if (mpz_sgn(z) == 0) return false;
    mpfr_set_z_2exp(raw(result_), z, -limb_bits * n_, MPFR_RNDN);
    const mpfr_exp_t known = mpfr_get_exp(raw(result_)) + limb_bits * n_ - bits_lost;
    const mpfr_prec_t precision = mpfr_get_prec(r);
    if (known <= precision || mpfr_can_round(raw(result_), known, MPFR_RNDN, MPFR_RNDZ, precision + 1) == 0)
      return false;
    // sin(a + quarters pi/2) is even in a for odd quarters, and odd for even ones.
    bool minus = quarters % 4 >= 2;
    if (turn == 0 && mpfr_signbit(a) != 0) minus = !minus;
    if (below_ && !is_cosine) minus = !minus;
    mpfr_setsign(r, raw(result_), minus, MPFR_RNDN);
    return true;
  }

 private:
  mp_limb_t* angle() { return room_.data(); }
  mp_limb_t* sine() { return angle() + n_ + 2; }
  mp_limb_t* versine() { return sine() + n_; }
  mp_limb_t* square() { return versine() + n_; }
  mp_limb_t* sum() { return square() + n_; }
  mp_limb_t* wide() { return sum() + n_ + 2; }

  /// The upper half of a product.
  const mp_limb_t* product(const mp_limb_t* a, const mp_limb_t* b) {
    mpn_mul_n(wide(), a, b, n_);
    return wide() + n_;
  }

  /// |a| is so many quarters of a turn and an angle to pi/4, or less that angle, if it is below them.
  unsigned long reduce(mpfr_srcptr a) {
    // A limb more on either side of the point than is kept.
    const long size = n_ + 2, given = (mpfr_get_prec(a) + limb_bits - 1) / limb_bits,
               shift = mpfr_get_exp(a) + limb_bits * (n_ + 1 - given), bits = std::abs(shift) % limb_bits,
               whole = std::abs(shift) / limb_bits;
    const auto* const significand = static_cast<const mp_limb_t*>(mpfr_custom_get_significand(a));
    mp_limb_t* const x = angle();
    std::fill_n(x, size, mp_limb_t{0});
    if (shift >= 0) {
      std::copy_n(significand, given, x + whole);
      if (bits != 0) {
        const mp_limb_t out = mpn_lshift(x + whole, x + whole, given, static_cast<unsigned>(bits));
        if (out != 0) x[whole + given] = out;
      }
    } else if (whole < given) {
      const long kept = given - whole;
      if (bits == 0)
        std::copy_n(significand + whole, kept, x);
      else
        mpn_rshift(x, significand + whole, kept, static_cast<unsigned>(bits));
    }
    const double turns = std::abs(mpfr_get_d(a, MPFR_RNDN)) / table_.quarter_in_double();
    const auto quarters = static_cast<unsigned long>(std::lround(turns));
    below_ = false;
    if (quarters > 0) {
      mpn_mul_1(wide(), table_.quarter(n_), size, quarters);
      below_ = mpn_cmp(x, wide(), size) < 0;
      if (below_)
        mpn_sub_n(x, wide(), x, size);
      else
        mpn_sub_n(x, x, wide(), size);
    }
    std::copy_n(x + 1, n_, x);
    return quarters;
  }

  /// The sine and the versine of the angle, or at least the one that is wanted.
  void expand(bool of_versine) {
    constexpr int bits = SineTable::step_bits;
    mp_limb_t& top = angle()[n_ - 1];
    const mp_limb_t all = top;
    top &= ~mp_limb_t{0} >> SineTable::rest_bits;
    series();
    for (int level = SineTable::levels; level >= 1; --level) {
      const mp_limb_t k = (all >> (limb_bits - level * bits)) % SineTable::steps;
      if (k != 0)
        add(table_.sine(n_, level, k), table_.versine(n_, level, k), level > 1 || !of_versine, level > 1 || of_versine);
    }
  }

  /// sin(a + x) = s_a + s - s_a v - v_a s and 1 - cos(a + x) = v_a + v - v_a v + s_a s
  void add(const mp_limb_t* s_a, const mp_limb_t* v_a, bool want_sine, bool want_versine) {
    mp_limb_t *const s = sine(), *const v = versine(), *const next = sum();
    if (want_sine) {
      mpn_add_n(next, s_a, s, n_);
      mpn_sub_n(next, next, product(s_a, v), n_);
      mpn_sub_n(next, next, product(v_a, s), n_);
    }
    if (want_versine) {
      std::copy_n(product(v_a, v), n_, square());
      mpn_add_n(v, v, v_a, n_);
      mpn_sub_n(v, v, square(), n_);
      mpn_add_n(v, v, product(s_a, s), n_);
    }
    if (want_sine) std::copy_n(next, n_, s);
  }

  /// sin x = x - x^3/3! + ...
  void series() {
    const mp_limb_t* const x = angle();
    mpn_sqr(wide(), x, n_);
    std::copy_n(wide() + n_, n_, square());
    horner();
    std::copy_n(product(sum(), square()), n_, versine());
    mpn_sub_n(sine(), x, product(versine(), x), n_);
    // 1 - sqrt(1 - sin^2 x)
    mpn_sqr(wide(), sine(), n_);
    if (mpn_neg(wide(), wide(), 2 * n_) == 0) {
      std::fill_n(versine(), n_, mp_limb_t{0});
      return;
    }
    mpn_sqrtrem(versine(), nullptr, wide(), 2 * n_);
    mpn_neg(versine(), versine(), n_);
  }

  /// 1/3! - x^2 (1/5! - x^2 (1/7! - ...)), each bracket with as many limbs as it is worth.
  void horner() {
    mp_limb_t* const all = sum();
    const auto worth = [&](long j) { return std::min(n_, n_ + 1 - SineTable::rest_bits * j / limb_bits); };
    long n = worth(table_.last(n_));
    std::copy_n(table_.factorial(n_, table_.last(n_)) + n_ - n, n, all + n_ - n);
    for (long j = table_.last(n_) - 2; j >= 3; j -= 2) {
      mpn_mul_n(wide(), all + n_ - n, square() + n_ - n, n);
      const mp_limb_t* const term = table_.factorial(n_, j);
      mpn_sub_n(all + n_ - n, term + n_ - n, wide() + n, n);
      const long longer = worth(j);
      std::copy_n(term + n_ - longer, longer - n, all + n_ - longer);
      n = longer;
    }
  }

  static const SineTable& shared_table() {
    static const SineTable table;
    return table;
  }

  const SineTable& table_ = shared_table();
  long n_ = 0;
  Limbs room_;
  BigFloat result_;
  bool below_ = false;
};

/// \returns whether r was set
bool set_by_table(mpfr_ptr r, mpfr_srcptr a, unsigned turn) {
  constexpr mpfr_exp_t least = -20, greatest = 20;
  if (mpfr_regular_p(a) == 0 || mpfr_get_exp(a) < least || mpfr_get_exp(a) > greatest) return false;
  if (SineEvaluation::limbs_for(r) > most_limbs) return false;
  thread_local SineEvaluation evaluation;
  return evaluation.evaluate(r, a, turn);
}

}  // namespace

bool has_sine_in_reach(mpfr_srcptr a) {
  constexpr mpfr_exp_t greatest = 131072;
  return mpfr_regular_p(a) == 0 || mpfr_get_exp(a) <= greatest;
}

void set_sin(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t) {
  if (set_by_table(r, a, 0)) return;
  if (has_sine_in_reach(a))
    mpfr_sin(r, a, MPFR_RNDN);
  else
    mpfr_set_nan(r);
}

void set_cos(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t) {
  if (set_by_table(r, a, 1)) return;
  if (has_sine_in_reach(a))
    mpfr_cos(r, a, MPFR_RNDN);
  else
    mpfr_set_nan(r);
}

}  // namespace hbvm::core
