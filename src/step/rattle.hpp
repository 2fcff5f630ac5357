#pragma once

#include "step/constraint_projection.hpp"
#include "step/method.hpp"

namespace hbvm::core {

enum class Kicks { two_halves, one_whole };

/// RATTLE (Andersen 1983), the symplectic method of order 2 for constrained systems:
///
///     p_1/2 = p_0 + h/2 (grad U(q_0) - grad g(q_0) lambda),   q_1 = q_0 + h M^-1 p_1/2,   g(q_1) = 0,
///     p_1   = p_1/2 + h/2 (grad U(q_1) - grad g(q_1) mu),     grad g(q_1)^T M^-1 p_1 = 0.
///
/// lambda is found by Newton's iteration to round-off from that of the last step, mu by a linear solve. The force at
/// the end of a step serves the next one. Without constraints this is Stormer-Verlet, the leapfrog.
///
/// With one whole kick at the start in place of two halves it is the symplectic Euler method, of order 1:
///
///     p_1/2 = p_0 + h (grad U(q_0) - grad g(q_0) lambda),   q_1 = q_0 + h M^-1 p_1/2,   g(q_1) = 0,
///     p_1   = p_1/2 - h grad g(q_1) mu,                      grad g(q_1)^T M^-1 p_1 = 0.
///
/// The multiplier is then lambda + mu: the force is in the first alone, and each has half of what bends the path.
template <Scalar S>
class Rattle final : public CountingStepper<S> {
 public:
  /// The problem must outlive it.
  explicit Rattle(const Problem<S>& problem, Kicks kicks = Kicks::two_halves);

  const Problem<S>& problem() const override { return problem_; }

  /// \return Newton iterations for the positions, and the multiplier: mu, or lambda + mu after one whole kick
  /// \throws StageFailure if they do not converge; the state is then as it was
  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  SolverCounts own_counts() const override;
  void remember_own(Archive& archive) override;
  /// The force at the state, and the directions in which it is constrained, unless they are there.
  void arrive(const Vector<S>& q);
  /// p_ = p_0 + kick_ grad U(q_0) and free_ = q_0 + h M^-1 p_, where q_1 were without constraints.
  void kick_and_drift(const State<S>& state);
  /// p_ += kick_ (grad U(q_1) - grad g(q_0) lambda), the force only if there are two kicks.
  void kick_back();

  const Problem<S>& problem_;
  bool is_halved_;
  S h_ = 0, kick_ = 0, factor_ = 0, one_half_;  ///< h; h/2 or h; -h kick_
  PotentialEvaluator<S> potential_;
  ConstraintProjection<S> projection_;
  Matrix<S> force_, lambda_, pull_;  // 1 x m and 1 x nu
  Vector<S> free_, q_, p_, v_, multiplier_;
  Vector<S> arrived_;  ///< where force_ and the directions are
  bool started_ = false;
  PartCount kicks_{"half kicks and drift"};
};

MethodPtr rattle_method();
MethodPtr symplectic_euler_method();

}  // namespace hbvm::core
