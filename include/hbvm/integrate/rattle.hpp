#pragma once

#include "hbvm/integrate/stepper.hpp"
#include "hbvm/linear/ordering.hpp"

namespace hbvm {

/// RATTLE (Andersen 1983), the symplectic method of order 2 for constrained systems, as the yardstick of cost:
///
///     p_1/2 = p_0 + h/2 (grad U(q_0) - grad g(q_0) lambda),   q_1 = q_0 + h M^-1 p_1/2,   g(q_1) = 0,
///     p_1   = p_1/2 + h/2 (grad U(q_1) - grad g(q_1) mu),     grad g(q_1)^T M^-1 p_1 = 0.
///
/// lambda is found by Newton's iteration to round-off from that of the last step, mu by a linear solve. The force at
/// the end of a step serves the next one.
template <Scalar S>
class Rattle {
 public:
  Rattle(const Problem<S>& problem, const S& step);

  /// \return Newton iterations for the positions
  /// \throws StageFailure if they do not converge; the state is then as it was
  long step(State<S>& state);

 private:
  /// x = (left^T M^-1 right)^-1 x. \return false if that is singular
  bool solve(ConstraintGradient<S>& left, const ConstraintGradient<S>& right, Matrix<S>& x);
  void force(const Vector<S>& q);

  const Problem<S>& problem_;
  S h_, half_;
  PotentialEvaluator<S> potential_;
  ConstraintGradient<S> gradients_[2];
  int now_ = 0;  ///< which of them is at the state
  Ordering order_;
  Lu<S> system_;
  Matrix<S> force_, lambda_, mu_, g_;  // 1 x m and 1 x nu
  Vector<S> free_, q_, p_, v_, x_;
  bool started_ = false;
};

#define HBVM_DECLARE(S) extern template class Rattle<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
