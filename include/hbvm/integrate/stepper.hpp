#pragma once

#include <memory>

#include "hbvm/solver/stage_solver.hpp"

namespace hbvm {

/// The propagated state. q_carry and p_carry are what rounding took from q and p in the last update and the next one
/// gives back (compensated summation), so that the sums lose no digits over many steps.
template <Scalar S>
struct State {
  Vector<S> q, p, q_carry, p_carry;

  State(const Vector<S>& q0, const Vector<S>& p0)
      : q(q0), p(p0), q_carry(Vector<S>::Zero(q0.size())), p_carry(Vector<S>::Zero(p0.size())) {}
};

/// One step of HBVM(k, s) of fixed size. Problem and method must outlive it.
template <Scalar S>
class Stepper {
 public:
  Stepper(const Problem<S>& problem, const Hbvm<S>& method, const S& step, SolverKind solver);

  const Problem<S>& problem() const { return problem_; }
  StageSolver<S>& solver() { return *solver_; }

  /// Advances the state by (q1p1new), q1 = q0 + h M^-1 gamma_0, p1 = p0 + h (psi_0 - zeta_0).
  /// \return sweeps over the stage equations
  /// \throws StageFailure; the state is then as it was
  long step(State<S>& state);

  /// The extrapolated multiplier (lagmul) of the last step: sum_i l_i(1) lambda_i.
  const Vector<S>& multiplier() const { return multiplier_; }

 private:
  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  std::unique_ptr<StageSolver<S>> solver_;
  Vector<S> multiplier_;
  S increment_, t_;
};

#define HBVM_DECLARE(S) extern template class Stepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
