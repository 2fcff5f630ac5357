#pragma once

#include <functional>
#include <string>
#include <vector>

#include "between/force_bounds.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

/// A motion by HBVM(s,s) that chooses its steps by itself. Let the motion be analytic within an ellipse about a step,
/// whose half axes add up to rho/2 steps. Then the Legendre coefficients of the momenta fall by rho each, and the error
/// of the output state is rho^(-2s). A step is so short that its coefficients fall as fast as the digits need. It is
/// also so short that the forces are bounded along such an ellipse, see ForceBounds.
class HbvmMotion {
 public:
  /// From this state on, with so many digits right, by steps of `longest` at most to begin with. Problem and method
  /// must outlive it.
  HbvmMotion(const Problem<Mpfr>& problem, const Hbvm<Mpfr>& method, const Vector<Mpfr>& q, const Vector<Mpfr>& p,
             double digits, const Mpfr& longest);

  /// \param after_step is called with the time from the start after every step, and may throw to end the work
  /// \throws IntegrationError where no step is short enough
  void advance_to(const Mpfr& t, const std::function<void(const Mpfr&)>& after_step);

  /// The propagated state.
  const State<Mpfr>& state() const { return state_; }
  const Vector<Mpfr>& q() const { return state_.q; }
  const Vector<Mpfr>& p() const { return state_.p; }
  /// The output state: q, the tangential p and the multiplier there, which have order 2s.
  ExactPoint output();
  long steps() const { return steps_; }

 private:
  /// log2 of a part of a time, in which velocity or acceleration carry a body or director as far as it is from the
  /// origin. Infinite where nothing moves.
  double first_length();
  /// log2 of how many times as long the last step might have been.
  double room(double log2_h) const;
  /// Whether the forces are bounded along the ellipse of the step that began at this state.
  bool is_bounded(const State<Mpfr>& from, const Mpfr& h, double log2_h, double log2_rho);
  /// The coefficients of the velocities of the driven points over a step.
  void set_driven(const State<Mpfr>& from, const Mpfr& h, Matrix<Mpfr>& v) const;
  void shorten(double by, const std::string& why);

  const Problem<Mpfr>& problem_;
  const Hbvm<Mpfr>& method_;
  HbvmStepper<Mpfr> stepper_;
  ForceBounds bounds_;
  StateEvaluator<Mpfr> point_;
  State<Mpfr> state_;
  Mpfr now_ = 0;
  double log2_rho_;            ///< that the digits need
  double log2_h_, most_log2_;  ///< of the next step, and of the first one that was tried
  long steps_ = 0;
};

}  // namespace hbvm::core
