#pragma once

#include "hbvm/method/runge_kutta.hpp"
#include "hbvm/solver/extrapolation.hpp"
#include "hbvm/solver/position_scale.hpp"
#include "hbvm/solver/stopping_rule.hpp"
#include "hbvm/step/stepper.hpp"

namespace hbvm {

/// Steps of a Runge-Kutta method, for a problem without constraints:
///
///     Q_i = q_0 + h sum_j A_ij V_j,   V_i = M^-1 P_i,         q_1 = q_0 + h sum_i b_i V_i,
///     P_i = p_0 + h sum_j A_ij F_j,   F_i = grad U(Q_i),      p_1 = p_0 + h sum_i b_i F_i.
///
/// If A is strictly lower triangular, the stages are computed one after the other. Else the P_i are found by
/// fixed-point iteration, a sweep being V from P, Q, F, and P anew; it starts from the extrapolation of the last
/// steps' P, and if that leads nowhere, once more from P = p0.
///
/// StoppingRule says when the iteration ends, from the change of P; it fails as FixedPoint does.
template <Scalar S>
class RungeKuttaStepper final : public Stepper<S> {
 public:
  /// The problem must outlive it.
  /// \throws InputError if the problem has constraints, or A is not s x s
  RungeKuttaStepper(const Problem<S>& problem, const RungeKutta<S>& method);

  const Problem<S>& problem() const override { return problem_; }
  bool is_explicit() const { return explicit_; }

  /// \return sweeps over the stages: 1 if the method is explicit
  /// \throws StageFailure if the iteration fails or anything is not finite; the state is then as it was
  long step(State<S>& state, const S& h) override;

  /// Of no constraint.
  const Vector<S>& multiplier() const override { return multiplier_; }
  SolverCounts counts() const override;
  void measure_time() override;
  void remember(Archive& archive) override;

 private:
  enum Part { stages, sums };
  PartCall call(Part part) { return {parts_[part], timed_}; }
  void describe_parts();

  void stages_in_turn(const State<S>& state);
  long solve(const State<S>& state);
  long iterate(const State<S>& state);
  void sweep(const State<S>& state);
  void update(State<S>& state, long sweeps);

  const Problem<S>& problem_;
  S h_ = 0;          ///< of the last step
  Matrix<S> A_, b_;  ///< s x s and 1 x s
  bool explicit_;
  PotentialEvaluator<S> potential_;
  Matrix<S> P_, P_before_, Q_, V_, F_;  ///< s x m
  // One stage of an explicit method, and the changes of the state.
  Vector<S> q_, p_, v_;
  Matrix<S> force_, position_change_, momentum_change_;  // 1 x m
  Extrapolation<S> extrapolation_;                       ///< of P
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  S size_ = 0, s_ = 0, t_ = 0;  // kept: creating them allocates
  Vector<S> multiplier_;        // empty
  std::vector<PartCount> parts_;
  bool timed_ = false;
  SolverCounts earlier_;  ///< those of a run that this one continues
};

#define HBVM_DECLARE(S) extern template class RungeKuttaStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
