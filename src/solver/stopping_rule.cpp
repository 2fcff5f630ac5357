#include "hbvm/solver/stopping_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/linear/constant_count.hpp"
#include "hbvm/scalar/binary_exponent.hpp"
#include "hbvm/scalar/in_place.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

/// Numbers below it are rounded to its multiples.
template <Scalar S>
S least_number() {
  if constexpr (std::same_as<S, Mpfr>)
    return 0;
  else
    return std::numeric_limits<S>::denorm_min();
}

/// Sizes are compared, and need no more digits than that, however many there are.
template <Scalar S, class... Sizes>
void shorten([[maybe_unused]] Sizes&... sizes) {
  if constexpr (std::same_as<S, Mpfr>)
    (mpfr_prec_round(raw(sizes), std::numeric_limits<double>::digits, MPFR_RNDN), ...);
}

/// exceeds() of sizes, which are not negative.
template <Scalar S>
bool is_greater(const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    return exceeds(a, b);
  else
    return a > b;
}

}  // namespace

template <Scalar S>
StoppingRule<S>::StoppingRule(Index coordinates, long roundings, int least_rate_bits)
    :  // A rate of 0.95 a sweep, from a start with no right digit.
      max_sweeps_(100 + 14 * significand_bits<S>()),
      bound_(S(roundings) * epsilon<S>()),
      negligible_(power_of_two<S>(-12) * epsilon<S>()),
      tiny_(S(roundings) * least_number<S>()),
      least_rate_(power_of_two<S>(-least_rate_bits)),
      coarse_bound_(power_of_two<S>(-10)),
      coordinates_(static_cast<std::size_t>(coordinates)) {
  shorten<S>(bound_, negligible_, tiny_, least_rate_, coarse_bound_, kappa_, rate_, last_rate_, t_, left_);
  for (Coordinate& x : coordinates_)
    shorten<S>(x.change, x.terms, x.scale, x.position, x.last, x.least, x.expected, x.noise, x.rounding, x.negligible,
               x.coarse, x.far, x.lost);
}

template <Scalar S>
void StoppingRule<S>::start(const Vector<S>& p0, const Vector<S>& positions) {
  sweeps_ = 0;
  coarse_ = true;
  terms_shown_ = false;
  p0_ = &p0;
  set(kappa_, one_);
  set(rate_, one_);
  for (Index j = 0; j < p0.size(); ++j) {
    Coordinate& x = at(j);
    set(x.position, positions[j]);
    set_product(x.lost, x.position, negligible_);
    set_zero(x.scale);
    set_zero(x.terms);
    set_zero(x.change);
    set_bounds(x);
  }
  finite_ = true;
}

template <Scalar S>
void StoppingRule<S>::expect_rate(const S& rate) {
  set(rate_, rate);
}

template <Scalar S>
void StoppingRule<S>::set_condition(double kappa) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_set_d(raw(kappa_), kappa, MPFR_RNDN);
  else
    kappa_ = S(kappa);
  for (Coordinate& x : coordinates_) set_far(x);
}

template <Scalar S>
void StoppingRule<S>::show_change(const Matrix<S>& now, const Matrix<S>& before, const S* factor) {
  with_constant_count<S>(now.rows(), [&](auto rows) {
    HeldScratch<S> t = t_;
    const S* a = now.data();
    const S* b = before.data();
    for (Coordinate& x : coordinates_) {
      for (Index i = 0; i < rows; ++i) {
        set_difference(t, a[i], b[i]);
        if (factor) set_product(t, t, *factor);
        raise_magnitude(x.change, t);
      }
      a += rows;
      b += rows;
    }
  });
}

template <Scalar S>
void StoppingRule<S>::show_change(const Matrix<S>& change) {
  const S* a = change.data();
  for (Coordinate& x : coordinates_)
    for (Index i = 0; i < change.rows(); ++i) raise_magnitude(x.change, *a++);
}

template <Scalar S>
void StoppingRule<S>::show_terms(const Matrix<S>& terms, const S* factor) {
  terms_shown_ = true;
  with_constant_count<S>(terms.rows(), [&](auto rows) {
    HeldScratch<S> t = t_;
    const S* a = terms.data();
    for (Coordinate& x : coordinates_) {
      for (Index i = 0; i < rows; ++i) {
        if (factor) set_product(t, a[i], *factor);
        raise_magnitude(x.terms, factor ? t : a[i]);
      }
      a += rows;
    }
  });
}

template <Scalar S>
void StoppingRule<S>::take_scales() {
  if (!terms_shown_) return;
  terms_shown_ = false;
  const S* p0 = p0_->data();
  for (Coordinate& x : coordinates_) {
    raise_magnitude(x.terms, *p0++);
    set(x.scale, x.terms);
    set_zero(x.terms);
    set_bounds(x);
    finite_ = finite_ && is_finite(x.scale);
  }
}

template <Scalar S>
bool StoppingRule<S>::look_at_changes() {
  HeldScratch<S> now = left_, t = t_;
  set(now, least_rate_);
  const bool first = sweeps_ == 1;
  bool finite = true, coarse = false, known = false;
  for (const Coordinate& x : coordinates_) {
    finite = finite && is_finite(x.change);
    coarse = coarse || is_greater(x.change, x.coarse);
    if (first || !is_greater(x.last, x.rounding)) continue;
    known = true;
    set_product(t, now, x.last);
    if (is_greater(x.change, t)) set_quotient(now, x.change, x.last);
  }
  coarse_ = coarse;
  if (!finite) return false;
  rate_shown_ = known;
  if (first) {
    set(last_rate_, rate_);
  } else if (known) {
    // The greater of this one and the one before, which in the second sweep is none.
    set(last_rate_, sweeps_ > 2 && is_greater(rate_, now) ? rate_ : now);
    set(rate_, now);
  }
  fast_ = !is_greater(last_rate_, coarse_bound_);
  return true;
}

template <Scalar S>
void StoppingRule<S>::set_bounds(Coordinate& x) {
  set_product(x.noise, x.scale, bound_);
  set_product(x.rounding, is_greater(x.scale, x.position) ? x.scale : x.position, bound_);
  set_product(x.negligible, x.scale, negligible_);
  set_product(x.coarse, x.scale, coarse_bound_);
  set_far(x);
}

template <Scalar S>
void StoppingRule<S>::set_far(Coordinate& x) {
  set_product(x.far, x.rounding, kappa_);
  if (is_greater(tiny_, x.far)) set(x.far, tiny_);
}

template <Scalar S>
bool StoppingRule<S>::is_lost(const Coordinate& x, const S& left) const {
  return !is_greater(x.scale, x.far) && !is_greater(left, x.lost);
}

template <Scalar S>
[[gnu::always_inline]] inline void StoppingRule<S>::follow_least(Coordinate& x, bool rounding) {
  HeldScratch<S> t = t_;
  if (!is_greater(x.least, x.change)) {
    set_product(t, x.least, sixteen_);
    if (rounding || !is_greater(x.change, t)) {
      ++x.waiting;
      return;
    }
    ++x.risen;
  }
  set(x.least, x.change);
  x.waiting = 0;
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_negligible(Coordinate& x, const S& rate, bool fast) {
  HeldScratch<S> left = left_, own = t_;
  const bool clean = is_greater(x.change, x.noise);
  if (clean)
    set(x.expected, x.change);
  else
    set_product(x.expected, x.expected, rate);
  if (!is_greater(x.change, x.negligible) && !is_greater(x.last, x.negligible)) return true;
  set_product(left, x.expected, rate);
  if (is_greater(left, x.negligible)) return fast && is_lost(x, left);
  if (!clean) return true;
  // A coordinate much smaller than its body's others may have a rate of its own.
  set_product(own, rate, x.last);
  if (!is_greater(x.change, own)) return true;
  set_quotient(own, x.change, x.last);
  set_product(own, own, x.expected);
  return !is_greater(own, x.negligible) || (fast && is_lost(x, left));
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled_at_once(Coordinate& x, const S& rate) {
  HeldScratch<S> left = left_;
  x.risen = x.waiting = x.vanishing = 0;
  set(x.least, x.change);
  set(x.expected, x.change);
  set_product(left, x.change, rate);
  return !is_greater(left, x.negligible);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled(Coordinate& x, const S& rate, bool fast) {
  HeldScratch<S> t = t_;
  const bool rounding = !is_greater(x.change, x.far);
  follow_least(x, rounding);
  if (!rounding) {
    x.vanishing = 0;
    // Most coordinates in most sweeps.
    set_product(t, x.change, rate);
    if (is_greater(t, x.negligible) && !(fast && is_lost(x, t))) {
      set(x.expected, x.change);
      return false;
    }
    return is_negligible(x, rate, fast);
  }
  set_sum(t, x.change, x.change);
  x.vanishing = is_greater(x.scale, t) ? 0 : x.vanishing + 1;
  if (is_negligible(x, rate, fast) || x.waiting >= 2 || x.settled || x.vanishing >= (fast ? 1 : 2)) return true;
  if (!fast) return false;
  set_product(t, x.rounding, kappa_);
  return !is_greater(x.scale, t);
}

template <Scalar S>
typename StoppingRule<S>::Verdict StoppingRule<S>::judge() {
  ++sweeps_;
  take_scales();
  if (!finite_ || !look_at_changes()) return Verdict::not_finite;

  const Held<S> rate = last_rate_;
  const bool first = sweeps_ == 1, fast = fast_;
  bool all = true, waiting_long = false;
  for (Coordinate& x : coordinates_) {
    x.settled = first ? is_settled_at_once(x, rate) : is_settled(x, rate, fast);
    if (!x.settled) {
      all = false;
      waiting_long = waiting_long || x.waiting + x.risen >= patience;
    }
    set(x.last, x.change);
    set_zero(x.change);
  }
  if (all) return Verdict::converged;
  if (waiting_long) return Verdict::stagnant;
  return sweeps_ >= max_sweeps_ ? Verdict::endless : Verdict::go_on;
}

template <Scalar S>
long StoppingRule<S>::least_left() const {
  long least = 0;
  for (const Coordinate& x : coordinates_)
    if (x.expected != 0)
      least = std::min(least, binary_exponent(x.expected) + binary_exponent(last_rate_) - binary_exponent(x.scale));
  return least;
}

template <Scalar S>
S StoppingRule<S>::relative_change() const {
  S greatest = 0;
  for (const Coordinate& x : coordinates_)
    if (x.last != 0) raise_to(greatest, S(x.last / x.scale));
  return greatest;
}

template <Scalar S>
bool StoppingRule<S>::grows() const {
  return std::any_of(coordinates_.begin(), coordinates_.end(),
                     [](const Coordinate& x) { return !x.settled && (x.risen > 1 || x.last > 2 * x.least); });
}

template <Scalar S>
StageFailure StoppingRule<S>::failure(Verdict verdict) const {
  const char* const what = verdict == Verdict::not_finite ? "an iterate is not finite"
                           : verdict == Verdict::endless  ? "the increments fall too slowly"
                           : grows()                      ? "the increments grow"
                                                          : "the increments stagnate";
  return {FailureCause::stage_equations_diverge, what, to_scientific(relative_change(), 3), sweeps_};
}

template <Scalar S>
double StoppingRule<S>::condition_wanted() const {
  double wanted = 1;
  for (const Coordinate& x : coordinates_)
    if (!x.settled) wanted = std::max(wanted, approximately(S(x.last / x.rounding)));
  return wanted;
}

#define HBVM_DEFINE(S) template class StoppingRule<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
