#pragma once

#include <optional>

#include "method/runge_kutta.hpp"
#include "problem/state_evaluator.hpp"
#include "solver/extrapolation.hpp"
#include "solver/position_scale.hpp"
#include "step/constraint_projection.hpp"
#include "step/formulation.hpp"
#include "step/stage_iteration.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// Steps of a Runge-Kutta method:
///
///     Q_i = q_0 + h sum_j A_ij V_j,   V_i = M^-1 P_i,                              q_1 = q_0 + h sum_i b_i V_i,
///     P_i = p_0 + h sum_j A_ij F_j,   F_i = grad U(Q_i) - grad g(Q_i) lambda_i,    p_1 = p_0 + h sum_i b_i F_i.
///
/// With constraints, lambda_i = lambda(Q_i, P_i) of Theorem 1. The solutions of these index-reduced equations keep g
/// and the hidden constraints, but those of the method do not, and drift away. Three formulations hold them back:
///
/// - Projected, each step ends on the constraints and in their tangent space, along grad g at its end.
/// - Baumgarte's has lambda + (grad g^T M^-1 grad g)^-1 (2 alpha g' + beta^2 g): g'' + 2 alpha g' + beta^2 g = 0
///   pulls the drift back (J. Baumgarte, 1972).
/// - That of Gear, Gupta and Leimkuhler (1985) has a second multiplier, q' = M^-1 (p - grad g(q) mu). The method is
///   half-explicit (V. Brasey and E. Hairer, 1993): mu_i and lambda_i are such that both constraints hold at stage
///   i + 1. Those of the last stage are for the end. It takes explicit methods whose entries below the diagonal are not
///   0.
///
/// If A is strictly lower triangular, the stages are computed one after the other. Else the P_i are found by
/// fixed-point iteration, a sweep being V from P, Q, F, and P anew. It starts from the extrapolation of the last steps'
/// P, and if that leads nowhere, once more from P = p0.
///
/// StoppingRule says when the iteration ends, from the change of P; it fails as FixedPoint does.
template <Scalar S>
class RungeKuttaStepper final : public CountingStepper<S> {
 public:
  /// The problem must outlive it.
  /// \throws InputError if A is not s x s, or the formulation does not take it
  RungeKuttaStepper(const Problem<S>& problem, const RungeKutta<S>& method, const Formulation& formulation = {});

  const Problem<S>& problem() const override { return problem_; }
  bool is_explicit() const { return explicit_; }

  /// \return sweeps over the stages, 1 if the method is explicit, and the multiplier of the state the step ends with
  /// \throws StageFailure if the iteration fails or anything is not finite; the state is then as it was
  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  enum Part { stages, sums, pulls };
  SolverCounts own_counts() const override;
  void remember_own(Archive& archive) override;
  void describe_parts();

  void stages_in_turn(const State<S>& state);
  long solve(const State<S>& state);
  long iterate(const State<S>& state);
  void sweep(const State<S>& state);
  /// Adds -grad g lambda of (Q_i, P_i) to the force on it, in row `row`.
  void add_constraint_force(const Vector<S>& Q, const Vector<S>& P, Matrix<S>& force, Index row);
  /// Of GGL, stage i: q and p onto the constraints by multipliers of the stage before. These are added to its V and F.
  void hold(Index i, Vector<S>& q, Vector<S>& p);
  /// The state onto the constraints, if it is to be; sets the multiplier.
  void settle(State<S>& state);

  const Problem<S>& problem_;
  S h_ = 0;            ///< of the last step
  S last_weight_ = 0;  ///< of GGL
  Matrix<S> A_;
  bool explicit_, ggl_;
  PotentialEvaluator<S> potential_;
  std::optional<StateEvaluator<S>> point_;  ///< if there are constraints, or forces without a potential
  std::optional<ConstraintProjection<S>> projection_;
  Matrix<S> P_, P_before_, Q_, V_, F_;  ///< s x m
  // One stage of an explicit method.
  Vector<S> q_, p_, v_;
  Matrix<S> force_;  // 1 x m
  StageSums<S> stage_sums_;
  Extrapolation<S> extrapolation_;  ///< of P
  Vector<S> sequence_;
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  S factor_ = 0, t_ = 0;  // kept: creating them allocates
  Vector<S> multiplier_;
  DrivenCourse<S> course_, arrival_;  ///< at the stages, and at the end
  Matrix<S> pull_, lane_;             // 1 x nu, 1 x m
  Vector<S> free_;                    ///< where a stage would be without its constraints
  State<S> before_;                   ///< where a step with constraints began
  std::vector<PartCount> parts_;
};

}  // namespace hbvm::core
