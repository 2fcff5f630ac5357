#pragma once

#include "problem/energy_terms.hpp"
#include "step/constraint_projection.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// What becomes of the energy that a projection takes.
enum class OnEnergy {
  lose,    ///< nothing
  restore  ///< p is scaled until H is what it was
};

/// Ends each step of another stepper, which keeps g, in the tangent space of the constraints, and goes on from there:
///
///     p_1 <- p_1 - grad g(q_1) mu,   grad g(q_1)^T M^-1 p_1 = 0,
///
/// the nearest momentum in the metric M^-1 that fulfils the hidden constraints. It takes the kinetic energy of what it
/// takes away, in every step, so that H falls. Restored, p_1 is then scaled by sqrt(1 + (H_0 - H_1)/T_1), which leaves
/// it tangential, but changes momenta that are conserved. Neither is symmetric.
///
/// H_0 is the energy of the state that the first step began with: what rounding does to H does not add up.
template <Scalar S>
class ProjectedStepper final : public ForwardingStepper<S> {
 public:
  ProjectedStepper(std::unique_ptr<Stepper<S>> inner, OnEnergy on_energy);

  /// \throws StageFailure as the other does, if the gradients of the constraints are linearly dependent, or if no
  /// scaling of p restores H. The state is then as it was
  StepResult<S> step(State<S>& state, const S& h) override;
  SolverCounts counts() const override;
  void remember(Archive& archive) override;

 private:
  /// Without those of the other stepper.
  SolverCounts own_counts() const;
  void take_energy(const State<S>& state);
  void project(State<S>& state);
  void restore(State<S>& state);

  using ForwardingStepper<S>::problem;
  OnEnergy on_energy_;
  ConstraintProjection<S> projection_;
  EnergyTerms<S> energy_;
  PartCount scaling_{"H restored"};
  State<S> before_;
  Vector<S> p_, v_;
  Vector<S> made_q_, made_p_;  ///< the end of the last step
  S H_ = 0;                    ///< to be kept from there on
  S s_ = 0, t_ = 0, change_ = 0;
  bool started_ = false;
  SolverCounts earlier_;  ///< own ones of a run that this one continues
};

/// projected_hbvm:K,S and restored_hbvm:K,S from "K,S": HBVM(k,s) whose state goes on projected. \throws InputError
MethodPtr projected_hbvm_method(std::string_view arguments);
MethodPtr restored_hbvm_method(std::string_view arguments);

}  // namespace hbvm::core
