#pragma once

#include "linear/lu.hpp"
#include "linear/ordering.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/discrete_force.hpp"
#include "solver/extrapolation.hpp"
#include "solver/position_scale.hpp"
#include "step/method.hpp"
#include "step/stage_iteration.hpp"

namespace hbvm::core {

/// Steps of the energy-momentum method of Gonzalez (J. Nonlinear Sci. 6, 1996; with constraints: Physica D 132, 1999),
/// of order 2 and symmetric:
///
///     q_1 = q_0 + h M^-1 (p_0 + p_1)/2,                                            g(q_1) = 0,
///     p_1 = p_0 + h (DU(q_0, q_1) - grad g((q_0 + q_1)/2) lambda),
///
/// DU is the discrete gradient of U, a DiscreteForce. That of g, which is quadratic, is its gradient in the middle. So
/// the step keeps H whatever U is, and the linear and angular momenta that effects and constraints keep. The equation
/// solved is g(q_1) = g(q_0), the hidden constraint of (p_0 + p_1)/2 in the middle. Of g(q_1) = 0 itself the round-off
/// over h would be in the momenta. p_1 alone leaves the hidden constraints by O(h^2).
///
/// A sweep of the iteration computes q_1 from P = (p_0 + p_1)/2, one step of Newton's method for the multipliers there,
/// and P anew. The iteration starts from the extrapolation of the last steps, and if that leads nowhere, once more from
/// P = p_0. StoppingRule says when it ends, from the change of P.
template <Scalar S>
class EnergyMomentum final : public CountingStepper<S> {
 public:
  /// The problem must outlive it.
  explicit EnergyMomentum(const Problem<S>& problem);

  const Problem<S>& problem() const override { return problem_; }
  /// \return sweeps, and the multiplier of the middle
  /// \throws StageFailure; the state is then as it was
  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  enum Part { motion, gradients, matrix, factors, solution };
  SolverCounts own_counts() const override;
  void remember_own(Archive& archive) override;
  void describe_parts();
  Index place(Index a) const { return order_.position[static_cast<std::size_t>(a)]; }

  long solve(const State<S>& state);
  long iterate(const State<S>& state);
  void sweep(const State<S>& state);
  /// q_1, and the middle, from V_.
  void move(const Vector<S>& q0);
  /// \return false if the matrix for the multipliers is singular
  [[nodiscard]] bool correct_multipliers();

  const Problem<S>& problem_;
  S h_ = 0, half_ = 0, one_half_;  ///< h, h/2
  S product_ = 0;                  ///< of two gradients
  DiscreteForce<S> force_;
  ConstraintGradient<S> middle_gradient_, end_gradient_;
  Ordering order_;
  Lu<S> system_;
  Matrix<S> P_, P_before_, V_, F_;  ///< 1 x m
  Vector<S> q1_, middle_;
  Matrix<S> lambda_, pull_, g_;  ///< 1 x nu
  Vector<S> x_;
  StageSums<S> sums_;
  Extrapolation<S> extrapolation_;  ///< of P and lambda
  Vector<S> sequence_;
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  Vector<S> multiplier_;
  std::vector<PartCount> parts_;
};

/// From no arguments. \throws InputError
MethodPtr energy_momentum_method();

}  // namespace hbvm::core
