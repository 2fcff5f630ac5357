#pragma once

#include <vector>

#include "linear/matrix.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

/// Decides when an iteration for momenta at the stages has come down to round-off: coordinate by coordinate, each
/// against its own scale, so that the digits of a light, slow or small one do not depend on what else moves.
///
/// The scale of a coordinate is the largest of |p0_j|, |gamma_ij| and h |psi_ij|, terms of the sum that its momenta are
/// (h zeta is what these leave, unless multipliers run wild, which is no reason to ask for less).
///
/// What rounding leaves behind is a random walk; what a stop leaves behind has the same sign step after step and adds
/// up. It has to stay below the walk for 2^24 steps, so below 2^-12 epsilon of the scale. A coordinate is settled
///
/// - if that is all the iteration still has to change: its change times the rate at which changes fall. The rate is the
///   greatest of any coordinate in the last two sweeps, or its own; but a change below C epsilon of its scale may be
///   rounding: none is compared with it, and the rate so far tells what it would be without. (Not even a change of 0
///   says more: numbers stand still from half of an ulp on, on the side from which the iteration comes.) No rate is
///   taken to be below a least one, since one fast fall is not a rate. Two changes in a row below that bound do as
///   well;
/// - or if its change is rounding: below C epsilon kappa of the larger of the scale and of what rounding of its
///   positions amounts to, and not below its least one (since it last rose to 16 times that) for two sweeps. C bounds
///   the roundings of a sweep, kappa the factor by which the constraints magnify them;
/// - or if it vanishes: below that bound, and changing by all it is for two sweeps, or one where changes fall to 2^-10
///   a sweep; there it need not change by all it is if that is below the bound, too, nor have come below it itself once
///   what is left to change is 2^-12 of what rounding of its positions amounts to. Nobody waits for what goes to 0.
template <Scalar S>
class StoppingRule {
 public:
  enum class Verdict {
    go_on,
    converged,
    stagnant,   ///< some coordinate's change has not come below its least one for `patience` sweeps, or rises and rises
    endless,    ///< more sweeps than any convergence worth the name would take
    not_finite  ///< a change or scale
  };
  static constexpr long patience = 40;

  /// \param least_rate_bits the least rate is 2^-least_rate_bits
  StoppingRule(Index coordinates, long roundings, int least_rate_bits = 10);

  /// A new iteration.
  /// \param positions what rounding of the positions amounts to, over epsilon, for each coordinate
  void start(const Vector<S>& p0, const Vector<S>& positions);
  /// A rate known before the second sweep.
  void expect_rate(const S& rate);
  /// kappa >= 1, from now on until the next start.
  void set_condition(double kappa);

  /// The change of each column in this sweep: now - before, times `factor` if there is one.
  void show_change(const Matrix<S>& now, const Matrix<S>& before, const S* factor = nullptr);
  void show_change(const Matrix<S>& change);
  void show_change(Index j, const S& change);
  /// Terms of each column, times `factor` if there is one; wanted in every sweep as long as changes are coarse.
  void show_terms(const Matrix<S>& terms, const S* factor = nullptr);

  /// On the changes and terms shown since the last judgement.
  Verdict judge();

  const S& rate() const { return rate_; }
  /// Whether the last sweep showed it: of changes that may be rounding there is none to be seen.
  bool shows_rate() const { return rate_shown_; }
  /// The error that is left of the coordinate that is nearest to its solution, over its scale, as log2.
  long least_left() const;
  const S& scale(Index j) const { return coordinates_[static_cast<std::size_t>(j)].scale; }

  /// Whether the last changes were above 2^-10 of the scale somewhere, and no rounding.
  bool is_coarse() const { return coarse_; }
  long sweeps() const { return sweeps_; }
  /// The greatest change of the last sweep over its scale.
  S relative_change() const;
  /// Of a verdict that is neither go_on nor converged, with what was seen.
  StageFailure failure(Verdict verdict) const;
  /// Whether all the coordinates that are not settled would be, were kappa so large; and how large it would have to be.
  double condition_wanted() const;

 private:
  struct Coordinate {
    S terms = 0;  ///< shown since the last judgement
    S scale = 0, position = 0, least = 0, expected = 0;
    /// Parts of the scale: C epsilon (of what rounding of the position amounts to, if that is larger), 2^-12 epsilon,
    /// and 2^-10, or `far` if that is larger.
    S noise = 0, rounding = 0, negligible = 0, coarse = 0;
    S far = 0;   ///< a greater change is no rounding
    S lost = 0;  ///< 2^-12 of what rounding of the position amounts to
    S open = 0;  ///< with more than that left to change it is not settled
    long waiting = 0, risen = 0, vanishing = 0;
    bool settled = false;
    bool small = false;  ///< no greater than its rounding may be
    /// It has come down sweep after sweep, and is neither rounding nor settled: `least` and `expected` are its last
    /// change then, and are not written down before that ends.
    bool falls = false;
  };
  Coordinate& at(Index j) { return coordinates_[static_cast<std::size_t>(j)]; }
  const S& last(const Coordinate& x) const { return last_[&x - coordinates_.data()]; }
  const S& expected(const Coordinate& x) const { return x.falls ? last(x) : x.expected; }
  /// Finds whether changes are finite and coarse, and at which rate they fall. \return false if one is not finite
  bool look_at_changes();
  /// Whether all that is left to change is negligible; updates what is expected of the next change.
  bool is_negligible(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  /// In the first sweep, and in others.
  bool is_settled_at_once(Coordinate& x, const S& change, const S& rate);
  bool is_settled(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  /// Whether a coordinate that falls does so in this sweep, too, as most do in most sweeps: nothing has to be noted.
  bool still_falls(const Coordinate& x, const S& change, const S& last, const S& rate);
  /// Whether it is rounding altogether, beside which what is left to change counts for nothing, where changes fall
  /// fast.
  bool is_lost(const Coordinate& x, const S& left) const;
  /// Updates the least change, and for how long there was none below it.
  void follow_least(Coordinate& x, const S& change);
  bool grows() const;
  void take_scales();
  /// The bounds of a coordinate, from its scale and what rounding of its position amounts to.
  void set_bounds(Coordinate& x);
  void set_far(Coordinate& x);

  long sweeps_ = 0, max_sweeps_;
  bool coarse_ = true, changes_shown_ = false, terms_shown_ = false, finite_ = true, rate_shown_ = false;
  bool fast_ = false;                         ///< changes fall to 2^-10 a sweep
  S bound_, negligible_, tiny_, least_rate_;  // C epsilon, 2^-12 epsilon, C times the least number
  S coarse_bound_, kappa_ = 1, rate_ = 1, last_rate_ = 1;
  S t_ = 0, left_ = 0, one_ = 1, sixteen_ = 16;
  const Vector<S>* p0_ = nullptr;
  Vector<S> change_, last_;  ///< of each coordinate: shown since the last judgement, and before
  std::vector<Coordinate> coordinates_;
};

#define HBVM_DECLARE(S) extern template class StoppingRule<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm::core
