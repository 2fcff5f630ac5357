#pragma once

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// The course of one Newton iteration: how its increments fall, and what follows from that. Increments are relative to
/// the scales of the momenta.
///
/// A Jacobian is kept while they fall by a factor of 10 or more a sweep. An expensive one is kept longer:
/// while the sweeps left cost less, at the rate so far, than a new one and two sweeps.
template <Scalar S>
class NewtonCourse {
 public:
  /// \param tolerance what rounding makes of an increment
  /// \param sweeps_an_evaluation how many sweeps cost as much as a Jacobian
  /// \param updated whether the Jacobian is expensive and is improved by BroydenUpdates
  NewtonCourse(const S& tolerance, double sweeps_an_evaluation, bool updated);

  /// Begins a new iteration.
  /// \param evaluates whether the Jacobian is evaluated at its start
  void start(bool evaluates);

  /// The increment of this sweep.
  S& change() { return change_; }
  const S& change() const { return change_; }
  /// Whether there is no increment before it to be compared with.
  bool begins() const { return !(last_ > 0); }
  /// Whether the Jacobian is, or has been, evaluated at the iterate of this sweep, and whether it was at the iterate
  /// before.
  bool evaluates() const { return evaluates_; }
  bool is_exact() const { return exact_; }

  /// Whether the iterate is a step too far from the one before.
  bool went_too_far() const;
  /// Halves that step. \return how often it was halved, or 0 if it must not be halved again
  int halve();
  /// Takes that step back: its Jacobian was an old one, and the next sweep evaluates one.
  void take_back();

  /// Whether the increment may be rounding altogether.
  bool is_rounding() const;
  /// Whether increments have not fallen for long with the Jacobian of the iterate itself. They are rounding then,
  /// however much an ill-conditioned problem magnifies it; but half of the digits must be left.
  bool is_on_floor() const;
  /// Goes on to the next iterate: decides whether the Jacobian is evaluated there.
  void go_on(long sweep);

 private:
  /// Whether the increment does not fall with the Jacobian of the iterate itself.
  bool waits() const;
  /// Whether a new Jacobian costs less than the sweeps that it saves, if increments go on to fall as they did.
  bool evaluation_pays() const;

  S tolerance_, root_epsilon_, coarse_;
  double sweeps_an_evaluation_;
  bool updated_;
  bool evaluates_ = false, exact_ = false;
  int halvings_ = 0;
  int falls_ = 0;                        ///< sweeps since the increment first_ with one Jacobian
  int rises_ = 0;                        ///< sweeps in a row in which increments did not become smaller
  int waiting_ = 0;                      ///< sweeps in a row that wait
  long small_ = 0;                       ///< sweeps in a row within the tolerance
  S change_ = 0, last_ = 0, first_ = 0;  ///< of this sweep, of the one before, and of the first with this Jacobian
};

}  // namespace hbvm::core
