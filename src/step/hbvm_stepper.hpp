#pragma once

#include <memory>

#include "step/stepper.hpp"

namespace hbvm::core {

/// Steps of HBVM(k, s). Problem and method must outlive it.
template <Scalar S>
class HbvmStepper final : public CountingStepper<S> {
 public:
  HbvmStepper(const Problem<S>& problem, const Hbvm<S>& method, SolverKind solver);
  /// The same, and keeps the method.
  HbvmStepper(const Problem<S>& problem, std::shared_ptr<const Hbvm<S>> method, SolverKind solver)
      : HbvmStepper(problem, *method, solver) {
    kept_method_ = std::move(method);
  }

  const Problem<S>& problem() const override { return problem_; }
  const StageSolver<S>& solver() const { return *solver_; }

  /// Advances the state by (56), q1 = q0 + h M^-1 gamma_0, p1 = p0 + h (psi_0 - zeta_0). The multiplier is extrapolated
  /// by (57): sum_i l_i(1) lambda_i.
  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  SolverCounts own_counts() const override;
  void remember_own(Archive& archive) override;

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  std::shared_ptr<const Hbvm<S>> kept_method_;
  std::unique_ptr<StageSolver<S>> solver_;
  Vector<S> multiplier_;
  DrivenCourse<S> arrival_;
  PartCount update_{"state and multiplier at the end"};
  S s_, t_;
};

}  // namespace hbvm::core
