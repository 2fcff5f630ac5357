#pragma once

#include "problem/state_evaluator.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// The index-reduced equations, whose solutions keep g and the hidden constraints where a method need not:
///
///     q' = M^-1 p,   p' = grad U(q) - grad g(q) lambda(q, p),   lambda of Theorem 1.
template <Scalar S>
class ReducedEquations {
 public:
  /// The problem must outlive it.
  explicit ReducedEquations(const Problem<S>& problem);

  /// \throws StageFailure if the gradients of the constraints are linearly dependent at q, or anything is not finite
  void evaluate(const Vector<S>& q, const Vector<S>& p);
  /// q', p' and lambda of the last evaluation.
  const Vector<S>& velocity() const { return velocity_; }
  const Vector<S>& force() const { return total_; }
  const Vector<S>& multiplier() const { return point_.last_multiplier(); }

  SolverCounts counts() const { return {potential_.counts(), parts_}; }

 private:
  enum Part { velocities, pulls };

  const Problem<S>& problem_;
  PotentialEvaluator<S> potential_;
  StateEvaluator<S> point_;
  Matrix<S> force_;  // 1 x m
  Vector<S> velocity_, total_;
  std::vector<PartCount> parts_;
};

/// Steps of a method for the index-reduced equations, as an ordinary differential equation in the changes of q and p
/// since the step began. The changes carry no round-off of q and p themselves, and are added with compensation. What is
/// evaluated at the end of a step, its multiplier among it, begins the next one.
template <Scalar S>
class ReducedStepper : public CountingStepper<S> {
 public:
  /// The problem must outlive it.
  explicit ReducedStepper(const Problem<S>& problem);

  const Problem<S>& problem() const override { return problem_; }
  /// \return the parts that advance() tells, and the multiplier of the state the step ends with
  /// \throws StageFailure; the state is then as it was
  StepResult<S> step(State<S>& state, const S& h) override;

 protected:
  /// Sets dq_ and dp_ to the changes over a step from the state it begins with. \return the parts it was tried in
  /// \throws StageFailure
  virtual long advance(const S& h) = 0;
  /// What else it remembers.
  virtual void remember_parts(Archive&) {}

  /// At the start.
  const Vector<S>& start_q() const { return q0_; }
  const Vector<S>& start_p() const { return p0_; }
  const Vector<S>& start_velocity() const { return velocity_; }
  const Vector<S>& start_force() const { return force_; }
  /// The equations where q and p have changed by dq_ and dp_.
  const ReducedEquations<S>& evaluate();

  Vector<S> dq_, dp_;

 private:
  SolverCounts own_counts() const override { return equations_.counts(); }
  void remember_own(Archive& archive) override;
  void arrive(const Vector<S>& q, const Vector<S>& p);

  const Problem<S>& problem_;
  ReducedEquations<S> equations_;
  Vector<S> q0_, p0_, q_, p_, velocity_, force_, multiplier_;
  State<S> before_;
  DrivenCourse<S> arrival_;
  bool started_ = false;
  S s_ = 0, t_ = 0;
};

}  // namespace hbvm::core
