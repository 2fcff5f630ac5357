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
    S& t = t_;
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
    const S* a = terms.data();
    for (Coordinate& x : coordinates_) {
      for (Index i = 0; i < rows; ++i) {
        if (factor) {
          set_product(t_, a[i], *factor);
          raise_magnitude(x.terms, t_);
        } else {
          raise_magnitude(x.terms, a[i]);
        }
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
void StoppingRule<S>::find_rate() {
  S& now = left_;
  bool known = false;
  if (sweeps_ > 1)
    for (const Coordinate& x : coordinates_) {
      if (!exceeds(x.last, x.rounding)) continue;
      if (!known) set(now, least_rate_);
      known = true;
      set_product(t_, now, x.last);
      if (exceeds(x.change, t_)) set_quotient(now, x.change, x.last);
    }
  rate_shown_ = known;
  if (!known) {
    if (sweeps_ == 1) set(last_rate_, rate_);
    return;
  }
  // The greater of this one and the one before, which in the second sweep is none.
  set(last_rate_, sweeps_ > 2 && exceeds(rate_, now) ? rate_ : now);
  set(rate_, now);
}

template <Scalar S>
void StoppingRule<S>::set_bounds(Coordinate& x) {
  set_product(x.noise, x.scale, bound_);
  set_product(x.rounding, exceeds(x.scale, x.position) ? x.scale : x.position, bound_);
  set_product(x.negligible, x.scale, negligible_);
  set_product(x.coarse, x.scale, coarse_bound_);
  set_far(x);
}

template <Scalar S>
void StoppingRule<S>::set_far(Coordinate& x) {
  set_product(x.far, x.rounding, kappa_);
  if (exceeds(tiny_, x.far)) set(x.far, tiny_);
}

template <Scalar S>
bool StoppingRule<S>::is_negligible(Coordinate& x) {
  const bool first = sweeps_ == 1;
  const bool clean = exceeds(x.change, x.noise);
  if (first || clean)
    set(x.expected, x.change);
  else
    set_product(x.expected, x.expected, last_rate_);
  set_product(left_, x.expected, last_rate_);
  if (!first && !exceeds(x.change, x.negligible) && !exceeds(x.last, x.negligible)) return true;
  if (exceeds(left_, x.negligible)) return false;
  if (first || !clean) return true;
  // A coordinate much smaller than its body's others may have a rate of its own.
  set_product(left_, last_rate_, x.last);
  if (!exceeds(x.change, left_)) return true;
  set_quotient(left_, x.change, x.last);
  set_product(left_, left_, x.expected);
  return !exceeds(left_, x.negligible);
}

template <Scalar S>
void StoppingRule<S>::follow_least(Coordinate& x, bool first, bool rounding) {
  set_product(t_, x.least, sixteen_);
  const bool rises = !first && !rounding && exceeds(x.change, t_);
  if (rises) ++x.risen;
  if (first || rises || exceeds(x.least, x.change)) {
    set(x.least, x.change);
    x.waiting = 0;
  } else {
    ++x.waiting;
  }
}

template <Scalar S>
bool StoppingRule<S>::is_lost(const Coordinate& x, const S& left) const {
  return fast_ && !exceeds(x.scale, x.far) && !exceeds(left, x.lost);
}

template <Scalar S>
bool StoppingRule<S>::is_far(Coordinate& x) {
  if (!exceeds(x.change, x.far)) return false;
  set_product(t_, x.change, last_rate_);
  if (!exceeds(t_, x.negligible) || is_lost(x, t_)) return false;
  set(x.expected, x.change);
  x.vanishing = 0;
  if (exceeds(x.least, x.change)) {
    set(x.least, x.change);
    x.waiting = 0;
  } else {
    follow_least(x, false, false);
  }
  return true;
}

template <Scalar S>
bool StoppingRule<S>::is_settled(Coordinate& x) {
  const bool first = sweeps_ == 1;
  bool negligible = is_negligible(x);
  if (!first && !negligible) {
    set_product(left_, x.expected, last_rate_);
    negligible = is_lost(x, left_);
  }
  set_product(t_, x.rounding, kappa_);
  const bool rounding = !exceeds(x.change, t_) || !exceeds(x.change, tiny_), only_rounding = !exceeds(x.scale, t_);
  if (first) x.risen = 0;
  follow_least(x, first, rounding);
  if (first || !rounding) {
    x.vanishing = 0;
  } else {
    set_sum(t_, x.change, x.change);
    x.vanishing = exceeds(x.scale, t_) ? 0 : x.vanishing + 1;
  }
  const bool vanishes = x.vanishing >= (fast_ ? 1 : 2) || (!first && fast_ && rounding && only_rounding);
  return negligible || (rounding && (x.waiting >= 2 || vanishes || (!first && x.settled)));
}

template <Scalar S>
typename StoppingRule<S>::Verdict StoppingRule<S>::judge() {
  ++sweeps_;
  take_scales();
  coarse_ = false;
  if (!finite_) return Verdict::not_finite;
  for (const Coordinate& x : coordinates_) {
    if (!is_finite(x.change)) return Verdict::not_finite;
    if (exceeds(x.change, x.coarse)) coarse_ = true;
  }
  find_rate();
  fast_ = !exceeds(last_rate_, coarse_bound_);

  bool all = true, waiting_long = false;
  for (Coordinate& x : coordinates_) {
    x.settled = !(sweeps_ > 1 && is_far(x)) && is_settled(x);
    all = all && x.settled;
    waiting_long = waiting_long || (!x.settled && x.waiting + x.risen >= patience);
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
