#include "hbvm/solver/stopping_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

template <Scalar S>
StoppingRule<S>::StoppingRule(Index coordinates, long roundings, int least_rate_bits)
    : size_(coordinates),
      // A rate of 0.95 a sweep, from a start with no right digit.
      max_sweeps_(100 + 14 * significand_bits<S>()),
      bound_(S(roundings) * epsilon<S>()),
      negligible_(power_of_two<S>(-12) * epsilon<S>()),
      tiny_(S(roundings) * least_number<S>()),
      least_rate_(power_of_two<S>(-least_rate_bits)),
      coarse_bound_(power_of_two<S>(-10)),
      change_(Vector<S>::Zero(coordinates)),
      last_(change_),
      least_(change_),
      expected_(change_),
      terms_(change_),
      scale_(change_),
      positions_(change_),
      waiting_(static_cast<std::size_t>(coordinates)),
      risen_(waiting_),
      vanishing_(waiting_),
      settled_(static_cast<std::size_t>(coordinates)) {}

template <Scalar S>
void StoppingRule<S>::start(const Vector<S>& p0, const Vector<S>& positions) {
  sweeps_ = 0;
  coarse_ = true;
  terms_shown_ = false;
  p0_ = &p0;
  set(kappa_, one_);
  set(rate_, one_);
  for (Index j = 0; j < size_; ++j) {
    set(positions_[j], positions[j]);
    set_zero(scale_[j]);
    set_zero(terms_[j]);
    set_zero(change_[j]);
  }
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
}

template <Scalar S>
void StoppingRule<S>::show_change(const Matrix<S>& now, const Matrix<S>& before, const S* factor) {
  for (Index j = 0; j < size_; ++j)
    for (Index i = 0; i < now.rows(); ++i) {
      set_difference(t_, now(i, j), before(i, j));
      if (factor) set_product(t_, t_, *factor);
      raise_magnitude(change_[j], t_);
    }
}

template <Scalar S>
void StoppingRule<S>::show_change(const Matrix<S>& change) {
  for (Index j = 0; j < size_; ++j)
    for (Index i = 0; i < change.rows(); ++i) raise_magnitude(change_[j], change(i, j));
}

template <Scalar S>
void StoppingRule<S>::show_terms(const Matrix<S>& terms, const S* factor) {
  terms_shown_ = true;
  for (Index j = 0; j < size_; ++j)
    for (Index i = 0; i < terms.rows(); ++i) {
      if (factor) {
        set_product(t_, terms(i, j), *factor);
        raise_magnitude(terms_[j], t_);
      } else {
        raise_magnitude(terms_[j], terms(i, j));
      }
    }
}

template <Scalar S>
void StoppingRule<S>::take_scales() {
  if (!terms_shown_) return;
  terms_shown_ = false;
  for (Index j = 0; j < size_; ++j) {
    raise_magnitude(terms_[j], (*p0_)[j]);
    set(scale_[j], terms_[j]);
    set_zero(terms_[j]);
  }
}

template <Scalar S>
void StoppingRule<S>::find_rate() {
  S& now = left_;
  bool known = false;
  for (Index j = 0; j < size_ && sweeps_ > 1; ++j) {
    set_rounding(j, t_);
    if (!exceeds(last_[j], t_)) continue;
    if (!known) set(now, least_rate_);
    known = true;
    set_product(t_, now, last_[j]);
    if (exceeds(change_[j], t_)) set_quotient(now, change_[j], last_[j]);
  }
  if (!known) {
    if (sweeps_ == 1) set(last_rate_, rate_);
    return;
  }
  // The greater of this one and the one before, which in the second sweep is none.
  set(last_rate_, sweeps_ > 2 && exceeds(rate_, now) ? rate_ : now);
  set(rate_, now);
}

template <Scalar S>
void StoppingRule<S>::set_rounding(Index j, S& bound) const {
  set_product(bound, exceeds(scale_[j], positions_[j]) ? scale_[j] : positions_[j], bound_);
}

template <Scalar S>
typename StoppingRule<S>::Verdict StoppingRule<S>::judge() {
  ++sweeps_;
  const bool first = sweeps_ == 1;
  take_scales();
  coarse_ = false;
  for (Index j = 0; j < size_; ++j) {
    if (!is_finite(change_[j]) || !is_finite(scale_[j])) return Verdict::not_finite;
    set_product(t_, scale_[j], coarse_bound_);
    if (exceeds(change_[j], t_)) coarse_ = true;
  }
  find_rate();

  bool all = true, waiting_long = false;
  for (Index j = 0; j < size_; ++j) {
    const auto n = static_cast<std::size_t>(j);
    set_product(t_, scale_[j], bound_);
    const bool clean = exceeds(change_[j], t_);
    set_product(left_, expected_[j], last_rate_);
    set(expected_[j], first || clean ? change_[j] : left_);
    set_product(left_, expected_[j], last_rate_);
    // A coordinate much smaller than its body's others may have a rate of its own.
    set_product(t_, last_rate_, last_[j]);
    if (clean && !first && exceeds(change_[j], t_)) {
      set_quotient(left_, change_[j], last_[j]);
      set_product(left_, left_, expected_[j]);
    }
    set_product(t_, scale_[j], negligible_);
    const bool negligible = !exceeds(left_, t_) || (!first && !exceeds(change_[j], t_) && !exceeds(last_[j], t_));
    set_rounding(j, t_);
    set_product(t_, t_, kappa_);
    const bool rounding = !exceeds(change_[j], t_) || !exceeds(change_[j], tiny_);
    if (first) risen_[n] = 0;
    set_product(t_, least_[j], sixteen_);
    const bool rises = !first && !rounding && exceeds(change_[j], t_);
    if (rises) ++risen_[n];
    if (first || rises || exceeds(least_[j], change_[j])) {
      set(least_[j], change_[j]);
      waiting_[n] = 0;
    } else {
      ++waiting_[n];
    }
    set_sum(t_, change_[j], change_[j]);
    vanishing_[n] = first || !rounding || exceeds(scale_[j], t_) ? 0 : vanishing_[n] + 1;
    const bool vanishes = vanishing_[n] >= (exceeds(last_rate_, coarse_bound_) ? 2 : 1);
    settled_[n] = negligible || (rounding && (waiting_[n] >= 2 || vanishes || (!first && settled_[n])));
    all = all && settled_[n];
    waiting_long = waiting_long || (!settled_[n] && waiting_[n] + risen_[n] >= patience);
    set(last_[j], change_[j]);
    set_zero(change_[j]);
  }
  if (all) return Verdict::converged;
  if (waiting_long) return Verdict::stagnant;
  return sweeps_ >= max_sweeps_ ? Verdict::endless : Verdict::go_on;
}

template <Scalar S>
long StoppingRule<S>::least_left() const {
  long least = 0;
  for (Index j = 0; j < size_; ++j)
    if (expected_[j] != 0)
      least = std::min(least, binary_exponent(expected_[j]) + binary_exponent(last_rate_) - binary_exponent(scale_[j]));
  return least;
}

template <Scalar S>
S StoppingRule<S>::relative_change() const {
  S greatest = 0;
  for (Index j = 0; j < size_; ++j)
    if (last_[j] != 0) raise_to(greatest, S(last_[j] / scale_[j]));
  return greatest;
}

template <Scalar S>
bool StoppingRule<S>::grows() const {
  for (Index j = 0; j < size_; ++j)
    if (!settled_[static_cast<std::size_t>(j)] && (risen_[static_cast<std::size_t>(j)] > 1 || last_[j] > 2 * least_[j]))
      return true;
  return false;
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
  S bound;
  for (Index j = 0; j < size_; ++j) {
    if (settled_[static_cast<std::size_t>(j)]) continue;
    set_rounding(j, bound);
    wanted = std::max(wanted, approximately(S(last_[j] / bound)));
  }
  return wanted;
}

#define HBVM_DEFINE(S) template class StoppingRule<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
