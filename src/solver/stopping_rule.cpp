#include "solver/stopping_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "interruption.hpp"
#include "linear/arrays.hpp"
#include "linear/constant_count.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
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

/// size = |x| or, if something was shown before, the greater of both.
template <Scalar S>
void show(S& size, const S& x, bool first) {
  if (!first)
    raise_magnitude(size, x);
  else
    set_magnitude(size, x);
}

/// bound = max(bound, a / b) if `wanted`. Whether it is raised is chance: in double, to divide takes less time than a
/// branch that was not foreseen.
template <Scalar S>
void raise_to_quotient(S& bound, const S& a, const S& b, bool wanted, [[maybe_unused]] S& t) {
  if constexpr (std::same_as<S, double>) {
    const double quotient = wanted ? a / b : 0;
    bound = quotient > bound ? quotient : bound;
  } else if (wanted) {
    set_product(t, bound, b);
    if (is_greater(a, t)) set_quotient(bound, a, b);
  }
}

}  // namespace

template <Scalar S>
StoppingRule<S>::StoppingRule(Index coordinates, long roundings, int least_rate_bits)
    :  // To the last digit at a rate of 0.95.
      max_sweeps_(100 + 14 * significand_bits<S>()),
      even_(least_rate_bits > usual_rate_bits),
      bound_(S(roundings) * epsilon<S>()),
      negligible_(power_of_two<S>(-12) * epsilon<S>()),
      tiny_(S(roundings) * least_number<S>()),
      least_rate_(power_of_two<S>(-least_rate_bits)),
      coarse_bound_(power_of_two<S>(-10)),
      change_(Vector<S>::Zero(coordinates)),
      last_(change_),
      coordinates_(static_cast<std::size_t>(coordinates)) {
  shorten<S>(bound_, negligible_, tiny_, least_rate_, coarse_bound_, kappa_, rate_, last_rate_, t_, left_);
  for (Coordinate& x : coordinates_)
    shorten<S>(x.terms, x.scale, x.position, x.least, x.expected, x.due, x.noise, x.rounding, x.negligible, x.coarse,
               x.far, x.lost, x.open);
  for (Index j = 0; j < coordinates; ++j) shorten<S>(change_[j], last_[j]);
}

template <Scalar S>
void StoppingRule<S>::start(const Vector<S>& p0, const Vector<S>& positions) {
  sweeps_ = 0;
  coarse_ = true;
  changes_shown_ = terms_shown_ = false;
  p0_ = &p0;
  set(kappa_, one_);
  set(rate_, one_);
  for (Index j = 0; j < p0.size(); ++j) {
    Coordinate& x = at(j);
    set(x.position, positions[j]);
    set_product(x.lost, x.position, negligible_);
    set_zero(x.scale);
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
  const bool first = !std::exchange(changes_shown_, true);
  with_constant_count<S>(now.rows(), [&](auto rows) {
    HeldScratch<S> t = t_;
    const S* __restrict const a = now.data();
    const S* __restrict const b = before.data();
    S* __restrict const change = change_.data();
    const Index columns = now.cols();
    for (Index j = 0; j < columns; ++j)
      for (Index i = 0; i < rows; ++i) {
        set_difference(t, a[j * rows + i], b[j * rows + i]);
        if (factor) set_product(t, t, *factor);
        show(change[j], t, first && i == 0);
      }
  });
}

template <Scalar S>
void StoppingRule<S>::show_change(const Matrix<S>& change) {
  const bool first = !std::exchange(changes_shown_, true);
  for (Index j = 0; j < change.cols(); ++j)
    for (Index i = 0; i < change.rows(); ++i) show(change_[j], change(i, j), first && i == 0);
}

template <Scalar S>
void StoppingRule<S>::show_change(Index j, const S& change) {
  if (!std::exchange(changes_shown_, true)) set_zero(change_);
  raise_magnitude(change_[j], change);
}

template <Scalar S>
void StoppingRule<S>::show_terms(const Matrix<S>& terms, const S* factor) {
  const bool first = !std::exchange(terms_shown_, true);
  with_constant_count<S>(terms.rows(), [&](auto rows) {
    HeldScratch<S> t = t_;
    const S* a = terms.data();
    for (Coordinate& x : coordinates_) {
      for (Index i = 0; i < rows; ++i) {
        if (factor) set_product(t, a[i], *factor);
        show(x.terms, factor ? t : a[i], first && i == 0);
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
    set_bounds(x);
    finite_ = finite_ && is_finite(x.scale);
  }
}

template <Scalar S>
bool StoppingRule<S>::look_at_changes() {
  HeldScratch<S> now = left_, t = t_;
  set(now, least_rate_);
  bool finite = true, coarse = false, known = false;
  // Two loops: to ask in each coordinate which sweep it is took 3 % of a sweep of HBVM(1,1).
  if (sweeps_ == 1) {
    for (Index j = 0; j < change_.size(); ++j) {
      finite &= is_finite(change_[j]);
      coarse |= is_greater(change_[j], at(j).coarse);
    }
  } else {
    for (Index j = 0; j < change_.size(); ++j) {
      const Coordinate& x = at(j);
      const Held<S> change = change_[j], last = last_[j];
      finite &= is_finite(change);
      coarse |= is_greater(change, x.coarse);
      const bool shows = is_greater(last, x.rounding);
      known |= shows;
      raise_to_quotient(now, change, last, shows, t);
    }
  }
  coarse_ = coarse;
  if (!finite) return false;
  rate_shown_ = known;
  if (sweeps_ == 1) {
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
  set_far(x);
}

template <Scalar S>
void StoppingRule<S>::set_far(Coordinate& x) {
  set_product(x.far, x.rounding, kappa_);
  if (is_greater(tiny_, x.far)) set(x.far, tiny_);
  set_product(x.coarse, x.scale, coarse_bound_);
  if (is_greater(x.far, x.coarse)) set(x.coarse, x.far);
  x.small = !is_greater(x.scale, x.far);
  set(x.open, x.small && is_greater(x.lost, x.negligible) ? x.lost : x.negligible);
}

template <Scalar S>
bool StoppingRule<S>::is_lost(const Coordinate& x, const S& left) const {
  const bool beside = !is_greater(left, x.lost);
  return x.small & beside;
}

template <Scalar S>
[[gnu::always_inline]] inline void StoppingRule<S>::follow_least(Coordinate& x, const S& change) {
  if (!is_greater(x.least, change)) {
    HeldScratch<S> t = t_;
    set_product(t, x.least, sixteen_);
    if (!is_greater(change, t)) {
      ++x.waiting;
      return;
    }
    ++x.risen;
  }
  set(x.least, change);
  x.waiting = 0;
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::little_is_left(Coordinate& x, const S& change, const S& last,
                                                                   const S& rate, bool fast) {
  HeldScratch<S> left = left_, own = t_;
  const bool clean = is_greater(change, x.noise);
  set_product(left, x.expected, rate);
  choose(x.expected, clean, change, left);
  set_product(left, x.expected, rate);
  const bool goes_on = is_greater(change, x.negligible), went_on = is_greater(last, x.negligible);
  const bool open = is_greater(left, x.negligible), lost = fast & is_lost(x, left), ended = !(goes_on | went_on);
  if (ended | open | !clean) return ended | !open | lost;
  // A coordinate much smaller than its body's others may have a rate of its own.
  set_product(own, rate, last);
  if (!is_greater(change, own)) return true;
  set_quotient(own, change, last);
  set_product(own, own, x.expected);
  return lost || !is_greater(own, x.negligible);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled_at_first(Coordinate& x, const S& change, const S& rate) {
  HeldScratch<S> left = left_;
  x.risen = x.waiting = x.vanishing = 0;
  x.fell = false;
  set(x.least, change);
  set(x.expected, change);
  set_product(left, change, rate);
  x.falls = is_greater(left, x.negligible);
  return !x.falls;
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::falls_on(Coordinate& x, const S& change, const S& last,
                                                             const S& rate, bool fast) {
  if (!x.falls || !is_greater(last, change) || !is_greater(change, x.far)) return false;
  HeldScratch<S> left = left_;
  x.fell = fast & even_;
  set_product(left, change, rate);
  return is_greater(left, x.open);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled_above_rounding(Coordinate& x, const S& change,
                                                                              const S& last, const S& rate, bool fast) {
  HeldScratch<S> left = t_;
  follow_least(x, change);
  x.vanishing = 0;
  x.fell = false;
  set_product(left, change, rate);
  if (is_greater(left, x.negligible) && !(fast && is_lost(x, left))) {
    set(x.expected, change);
    x.falls = x.waiting + x.risen == 0;
    return false;
  }
  return little_is_left(x, change, last, rate, fast);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::stops(Coordinate& x, const S& change, const S& last, const S& rate,
                                                          bool fast) {
  if (!x.fell) {
    // Of a last change above rounding, the rate is that of this coordinate, too, or a slower one.
    x.fell = even_ && fast && is_greater(last, x.rounding);
    set(x.due, change);
    return false;
  }
  HeldScratch<S> bound = left_;
  set_product(x.due, x.due, rate);
  set_product(bound, x.due, far_above_);
  return is_greater(change, bound);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled_within_rounding(Coordinate& x, const S& change,
                                                                               const S& last, const S& rate,
                                                                               bool fast) {
  HeldScratch<S> twice = t_;
  // What rounding does is chance, which no branch can foresee.
  const bool lower = is_greater(x.least, change);
  lower_finite(x.least, change);
  x.waiting = by_chance(lower) ? 0 : x.waiting + 1;
  set_sum(twice, change, change);
  x.vanishing = by_chance(is_greater(x.scale, twice)) ? 0 : x.vanishing + 1;
  const bool stopped = stops(x, change, last, rate, fast);
  const bool little = little_is_left(x, change, last, rate, fast);
  const bool stands_still = x.waiting >= 2, vanishes = x.vanishing >= (fast ? 1 : 2);
  return little | stands_still | stopped | x.settled | vanishes | (fast & x.small);
}

template <Scalar S>
[[gnu::always_inline]] inline bool StoppingRule<S>::is_settled(Coordinate& x, const S& change, const S& last,
                                                               const S& rate, bool fast) {
  if (x.falls) {
    x.falls = false;
    set(x.least, last);
    set(x.expected, last);
    set(x.due, last);
  }
  return is_greater(change, x.far) ? is_settled_above_rounding(x, change, last, rate, fast)
                                   : is_settled_within_rounding(x, change, last, rate, fast);
}

template <Scalar S>
typename StoppingRule<S>::Verdict StoppingRule<S>::judge() {
  // A step that takes more than this is likely to fail in the end, after thousands in many digits.
  constexpr long usual = 100;
  if (++sweeps_ > usual) end_if_asked("the stage equations were not solved");
  take_scales();
  if (!finite_ || !look_at_changes()) return Verdict::not_finite;

  const Held<S> rate = last_rate_;
  const bool first = sweeps_ == 1, fast = fast_;
  bool all = true, waiting_long = false;
  for (Index j = 0; j < change_.size(); ++j) {
    Coordinate& x = at(j);
    const Held<S> change = change_[j], last = last_[j];
    if (!first && falls_on(x, change, last, rate, fast)) {  // as most do in most sweeps: nothing has to be noted
      all = false;
      continue;
    }
    x.settled = first ? is_settled_at_first(x, change, rate) : is_settled(x, change, last, rate, fast);
    all &= x.settled;
    waiting_long |= !x.settled & (x.waiting + x.risen >= patience);
  }
  change_.swap(last_);
  changes_shown_ = false;
  if (all) return Verdict::converged;
  if (waiting_long) return Verdict::stagnant;
  return sweeps_ >= max_sweeps_ ? Verdict::endless : Verdict::go_on;
}

template <Scalar S>
long StoppingRule<S>::least_left() const {
  long least = 0;
  for (const Coordinate& x : coordinates_)
    if (expected(x) != 0)
      least = std::min(least, binary_exponent(expected(x)) + binary_exponent(last_rate_) - binary_exponent(x.scale));
  return least;
}

template <Scalar S>
S StoppingRule<S>::relative_change() const {
  S greatest = 0;
  for (const Coordinate& x : coordinates_)
    if (last(x) != 0) raise_to(greatest, S(last(x) / x.scale));
  return greatest;
}

template <Scalar S>
bool StoppingRule<S>::grows() const {
  return std::any_of(coordinates_.begin(), coordinates_.end(), [&](const Coordinate& x) {
    return !x.settled && !x.falls && (x.risen > 1 || last(x) > 2 * x.least);
  });
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
    if (!x.settled) wanted = std::max(wanted, approximately(S(last(x) / x.rounding)));
  return wanted;
}

#define HBVM_DEFINE(S) template class StoppingRule<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
