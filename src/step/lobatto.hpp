#pragma once

#include "solver/extrapolation.hpp"
#include "solver/position_scale.hpp"
#include "step/constraint_projection.hpp"
#include "step/method.hpp"
#include "step/stage_iteration.hpp"

namespace hbvm::core {

/// The coefficients of the Lobatto IIIA-IIIB pair of s >= 2 stages on [0, 1] with c_1 = 0 and c_s = 1. A is the
/// collocation method IIIA, whose first row is 0 and whose last row is b. A_hat is IIIB, b_i a_hat_ij + b_j a_ji =
/// b_i b_j, whose last column is 0.
template <Scalar S>
struct Lobatto {
  Vector<S> c, b;
  Matrix<S> A, A_hat;
  Matrix<S> A_A_hat;  ///< what a multiplier at stage j does to the position of stage i, over h^2

  int s() const { return static_cast<int>(b.size()); }
};

/// Computed with guard digits and rounded once. \throws InputError unless 2 <= s <= max_s
template <Scalar S>
Lobatto<S> make_lobatto(int s);

/// Steps of the Lobatto IIIA-IIIB pair for constrained Hamiltonian systems (Jay 1996; Hairer, Lubich, Wanner: Geometric
/// Numerical Integration, VII.1.4). They are symplectic, symmetric and of order 2s - 2:
///
///     Q_i = q_0 + h sum_j a_ij M^-1 P_j,                                           g(Q_i) = 0,   i = 2 .. s,
///     P_i = p_0 + h sum_j a_hat_ij (grad U(Q_j) - grad g(Q_j) lambda_j),           q_1 = Q_s,
///     p_1 = p_0 + h sum_i b_i (grad U(Q_i) - grad g(Q_i) lambda_i),                grad g(q_1)^T M^-1 p_1 = 0.
///
/// lambda_1 .. lambda_{s-1} are found from g(Q_i) = 0, lambda_s from the last condition. s = 2 is RATTLE.
///
/// A sweep of the iteration computes Q from P, one step of Newton's method for the multipliers there, and P anew. The
/// iteration starts from the extrapolation of the last steps, and if that leads nowhere, once more from P = p_0.
/// StoppingRule says when it ends, from the change of P.
template <Scalar S>
class LobattoStepper final : public CountingStepper<S> {
 public:
  /// The problem must outlive it.
  LobattoStepper(const Problem<S>& problem, std::shared_ptr<const Lobatto<S>> method);

  const Problem<S>& problem() const override { return problem_; }
  /// \return sweeps, and lambda_s
  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  enum Part { stages, gradients, matrix, factors, solution, sums };
  SolverCounts own_counts() const override;
  void remember_own(Archive& archive) override;
  void describe_parts();
  Index place(Index a) const { return order_.position[static_cast<std::size_t>(a)] * (method_->s() - 1); }

  long solve(const State<S>& state);
  long iterate(const State<S>& state);
  /// \return false if the matrix for the multipliers is singular
  [[nodiscard]] bool sweep(const State<S>& state);
  [[nodiscard]] bool correct_multipliers();
  void update(State<S>& state, long sweeps);

  const Problem<S>& problem_;
  std::shared_ptr<const Lobatto<S>> method_;
  S h_ = 0;  ///< of the last step
  PotentialEvaluator<S> potential_;
  ConstraintGradient<S> gradient_;
  ConstraintProjection<S> projection_;  ///< of the end of the step
  Ordering order_;
  Lu<S> system_;
  Matrix<S> P_, P_before_, Q_, V_, F_;  // s x m; F_ with the constraints' forces
  Matrix<S> lambda_, pull_, g_;         // s x nu; the last row of lambda_ is 0
  Matrix<S> coupling_;                  // s x s
  Vector<S> rhs_;                       // (s - 1) nu
  StageSums<S> stage_sums_;
  Extrapolation<S> extrapolation_;  ///< of P and lambda
  Vector<S> sequence_;              // s (m + nu)
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  State<S> before_;
  Vector<S> multiplier_;
  S t_ = 0;
  std::vector<PartCount> parts_;
};

/// From "S". \throws InputError
MethodPtr lobatto_method(std::string_view arguments);

}  // namespace hbvm::core
