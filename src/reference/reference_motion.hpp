#pragma once

#include <functional>

#include "problem/state_evaluator.hpp"
#include "scalar/log2_of.hpp"
#include "solver/solver_kind.hpp"

namespace hbvm::core {

/// The solution within one step: the polynomials u and v of (21), from their coefficients.
struct StepPolynomials {
  Mpfr h;
  Vector<Mpfr> q0, p1;
  Matrix<Mpfr> gamma;  ///< s x m

  /// u(tau h) and v(tau h), 0 <= tau <= 1. The coefficient of P_s in v is what takes v(h) to p1.
  void at(const Problem<Mpfr>& problem, const Mpfr& tau, Vector<Mpfr>& u, Vector<Mpfr>& v) const;
};

/// The exact motion from a consistent state over a time, in the digits of the scope. Gauss methods of more and more
/// stages give it. It is a run by the fixed-point iteration. Its error is estimated by what changed from the run
/// before, which Newton's iteration made with fewer stages. At the end q, the projected p and the multiplier there
/// converge with order 2s.
class ReferenceMotion {
 public:
  /// \param stages of the first run; every further one has two more
  /// \param after_step is called after every step, and may throw to end the work
  /// \throws StageFailure, IntegrationError
  ReferenceMotion(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0, const Vector<Mpfr>& p0, const Mpfr& duration,
                  long steps, int stages, std::function<void()> after_step = {});

  /// The state at the end of the time.
  const Vector<Mpfr>& q() const { return q_; }
  const Vector<Mpfr>& p() const { return p_; }
  const Vector<Mpfr>& lambda() const { return lambda_; }
  /// log2 of the estimated errors: of those one run earlier, so that they err on the safe side.
  struct Errors {
    double q, p, lambda;
  };
  const Errors& errors() const { return errors_; }
  /// The polynomials of the last step.
  const StepPolynomials& polynomials() const { return polynomials_; }

  /// Whether the errors of q and p are round-off: each a thousand units of its own at most.
  bool is_exact() const;
  /// One more run, unless the last one changed nothing but round-off. \return whether it was made
  bool refine();

 private:
  void run(SolverKind solver);
  /// log2 of one unit of round-off of q and of p: of what they are and what they change by.
  double q_unit() const;
  double p_unit() const;

  const Problem<Mpfr>& problem_;
  Vector<Mpfr> q0_, p0_;
  Mpfr duration_;
  long steps_;
  int stages_;
  std::function<void()> after_step_;
  StateEvaluator<Mpfr> point_;
  Vector<Mpfr> q_, p_, lambda_;
  StepPolynomials polynomials_;
  Errors errors_;  ///< infinite before the second run
};

}  // namespace hbvm::core
