#pragma once

#include <vector>

#include "linear/matrix.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

/// Decides when an iteration for momenta at the stages has come down to round-off. It judges coordinate by coordinate,
/// each against its own scale. So the digits of a light, slow or small one do not depend on what else moves.
///
/// What rounding leaves behind is a random walk. What a stop leaves behind has the same sign step after step and adds
/// up. It has to stay below the walk for 2^24 steps, so below 2^-12 epsilon of the scale.
///
/// Of a coordinate the rule knows, in each sweep,
///
///     change, last   the greatest change shown in this sweep, and in the one before
///     scale          the greatest of |p0_j|, |gamma_ij| and h |psi_ij|, terms of the sum that its momenta are
///     position       what rounding of its positions amounts to, over epsilon
///     least          its least change; it begins anew with a change of more than 16 times that, a rise
///     expected       its change, or if that is not above noise what its last one above would be by now, at the rate
///     due            where changes fall evenly, and once it fell fast from above rounding: what its last change then
///                    would be by now, at the rate
///
/// (h zeta is what the other terms leave. Multipliers may run wild, but that is no reason to ask for less.) From these
/// follow bounds, where C bounds the roundings of a sweep, and kappa the factor by which constraints magnify them:
///
///     noise        C epsilon scale: a change up to it may be rounding, and no rate comes from it
///     rounding     C epsilon times the larger of scale and position: a change up to it shows no rate in the next sweep
///     far          kappa rounding, and C times the least number at least: a greater change is no rounding
///     negligible   2^-12 epsilon scale: so much may be left to change
///     lost         2^-12 epsilon position: so much is not seen beside the rounding of positions
///
/// A coordinate is small if its scale is not above far. Then it may be rounding altogether.
///
/// The rate is the greatest change / last, in this sweep or the one before, of all coordinates whose last was above
/// rounding. It is at least 2^-least_rate_bits, since one fast fall is no rate. A sweep in which no coordinate shows
/// one has that of the sweep before, the first the rate expected, or 1. Changes fall fast if it is 2^-10 or less.
///
///     | case            | where                            | settled                                      |
///     |-----------------|----------------------------------|----------------------------------------------|
///     | first sweep     |                                  | if rate change <= negligible                 |
///     | falls on        | change > far, less than all      | no                                           |
///     |                 | before, rate change > negligible |                                              |
///     |                 | (and > lost, if it is small)     |                                              |
///     | above rounding  | else, change > far               | if little is left                            |
///     | within rounding | change <= far                    | if little is left, or it was settled before, |
///     |                 |                                  | or stands still, or stops, or vanishes,      |
///     |                 |                                  | or is small and changes fall fast            |
///
/// Little is left
///
/// - if neither change nor last is above negligible. A change of 0 alone says nothing: numbers stand still from half of
///   an ulp on, on the side from which the iteration comes.
/// - if rate expected is not above negligible. A coordinate much smaller than its body's others may fall at a rate of
///   its own. So a change above noise has to satisfy this with change / last for the rate, too.
/// - if it is small, changes fall fast and rate expected is not above lost.
///
/// It stands still if its change was not below its least for two sweeps. It stops if its change is above 2^12 times
/// what is due. Then it is rounding, and the error that is left is 2^-12 of it. So it is with the momentum of a body
/// far from the origin, in a direction in which nothing moves. Rounding of its position is in it, and may be much
/// greater than negligible. It vanishes if it changes by half of its scale or more for two sweeps, or for one if
/// changes fall fast. Its scale goes to 0 with it then, and no bound is reached.
///
/// The verdict is the first of these that holds:
///
///     | verdict    | where                                                                               |
///     |------------|-------------------------------------------------------------------------------------|
///     | not_finite | a change or a scale is not finite                                                   |
///     | converged  | all coordinates are settled                                                         |
///     | stagnant   | of one that is not, the sweeps since its least change and its rises make `patience` |
///     | endless    | a rate of 0.95 would have led here from a start with no right digit                 |
///     | go_on      | else                                                                                |
template <Scalar S>
class StoppingRule {
 public:
  enum class Verdict { go_on, converged, stagnant, endless, not_finite };
  static constexpr long patience = 40;

  /// \param least_rate_bits the least rate is 2^-least_rate_bits. More than the usual ones are for changes that fall
  /// evenly, as those of Newton's iteration with the Jacobian of the solution do. The fixed point's may fall fast once,
  /// and slowly from then on.
  static constexpr int usual_rate_bits = 10;
  StoppingRule(Index coordinates, long roundings, int least_rate_bits = usual_rate_bits);

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
    S scale = 0, position = 0, least = 0, expected = 0, due = 0;
    S noise = 0, rounding = 0, negligible = 0, far = 0, lost = 0;
    S coarse = 0;        ///< 2^-10 scale, or far if that is larger
    S open = 0;          ///< negligible, or lost if it is small and that is larger
    long waiting = 0;    ///< sweeps since its change was last below its least
    long risen = 0;      ///< rises
    long vanishing = 0;  ///< sweeps in which it changed by half of its scale
    bool settled = false, small = false;
    /// In the case "falls on" so far: `least`, `expected` and `due` are its last change then, and are not written down
    /// before that ends.
    bool falls = false;
    bool fell = false;  ///< fast, from above rounding
  };
  Coordinate& at(Index j) { return coordinates_[static_cast<std::size_t>(j)]; }
  const S& last(const Coordinate& x) const { return last_[&x - coordinates_.data()]; }
  const S& expected(const Coordinate& x) const { return x.falls ? last(x) : x.expected; }
  /// Finds whether changes are finite and coarse, and at which rate they fall. \return false if one is not finite
  bool look_at_changes();
  /// The cases of a coordinate.
  bool is_settled_at_first(Coordinate& x, const S& change, const S& rate);
  bool falls_on(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  bool is_settled(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  bool is_settled_above_rounding(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  bool is_settled_within_rounding(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  /// Updates what is expected of it.
  bool little_is_left(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  bool is_lost(const Coordinate& x, const S& left) const;
  /// Whether its change, which is within rounding, has become greater than it could be if it still fell.
  bool stops(Coordinate& x, const S& change, const S& last, const S& rate, bool fast);
  /// Its least change, its rises, and for how long there was no change below the least.
  void follow_least(Coordinate& x, const S& change);
  bool grows() const;
  void take_scales();
  /// The bounds of a coordinate, from its scale and what rounding of its position amounts to.
  void set_bounds(Coordinate& x);
  void set_far(Coordinate& x);

  long sweeps_ = 0, max_sweeps_;
  bool coarse_ = true, changes_shown_ = false, terms_shown_ = false, finite_ = true, rate_shown_ = false;
  bool fast_ = false, even_;                  ///< whether changes fall fast; evenly
  S bound_, negligible_, tiny_, least_rate_;  // C epsilon, 2^-12 epsilon, C times the least number
  S coarse_bound_, kappa_ = 1, rate_ = 1, last_rate_ = 1;
  S t_ = 0, left_ = 0, one_ = 1, sixteen_ = 16, far_above_ = 4096;
  const Vector<S>* p0_ = nullptr;
  Vector<S> change_, last_;  ///< of each coordinate: shown since the last judgement, and before
  std::vector<Coordinate> coordinates_;
};

}  // namespace hbvm::core
