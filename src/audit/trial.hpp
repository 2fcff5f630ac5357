#pragma once

#include <memory>
#include <optional>

#include "laboratory.hpp"
#include "reference/reference_motion.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// to = from, entry by entry, in the digits that `to` has.
template <class To, class From>
void copy_exactly(To& to, const From& from) {
  for (Index i = 0; i < from.size(); ++i) {
    const BigFloat value = exactly(from.data()[i]);
    mpfr_set(raw(to.data()[i]), raw(value), MPFR_RNDN);
  }
}

/// The method under audit on a problem, in the working precision S. What it hands out is exact in the digits of the
/// laboratory's scope, which it may be called from. Its own work is done in a scope of `digits`.
template <Scalar S>
class Trial {
 public:
  /// To be made in a scope of S.
  Trial(const Claim& subject, SolverKind solver = SolverKind::newton);

  /// The next step starts at this state, rounded, and is h long.
  void begin(const Laboratory::Start& start, const Mpfr& h);
  /// \return sweeps. \throws StageFailure
  long step();
  /// From here on the way back: p = -p, or where a force is none of a potential, steps of -h.
  void reverse();

  void state(Vector<Mpfr>& q, Vector<Mpfr>& p) const;
  /// The output state after a time from here, which may be a part of a step.
  void between(const Mpfr& after, Vector<Mpfr>& q, Vector<Mpfr>& p, Vector<Mpfr>& lambda) const;
  /// (57) of the last step.
  void multiplier(Vector<Mpfr>& lambda) const;
  /// Coefficients of the last step and its multipliers at the s Gauss nodes, each if asked for; not for a method
  /// without polynomials.
  void unknowns(Matrix<Mpfr>* gamma, Matrix<Mpfr>* lambda);
  bool has_polynomials() const { return last_.unknowns; }

 private:
  unsigned digits_;
  Assembled<S> assembled_;
  StepperMaker<S> make_stepper_;
  std::unique_ptr<Stepper<S>> stepper_;
  std::optional<State<S>> state_;
  StepResult<S> last_;
  bool coefficients_of_lambda_ = false;  ///< are its unknowns
  S h_ = 0;
};

/// The solution polynomials of the trial's last step, which went from q0 to p1 in h.
template <Scalar S>
StepPolynomials polynomials(Trial<S>& trial, const Vector<Mpfr>& q0, const Vector<Mpfr>& p1, const Mpfr& h, Index s);

/// The greatest |lambda(u(c_j h), v(c_j h)) - lambda_j| of (33) in that step.
template <Scalar S>
Mpfr delta_lambda(Laboratory& laboratory, Trial<S>& trial, const Vector<Mpfr>& q0, const Vector<Mpfr>& p1,
                  const Mpfr& h, Index s);

}  // namespace hbvm::core
