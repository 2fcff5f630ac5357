#include "step/reduced_stepper.hpp"

#include <algorithm>

#include "copy_state.hpp"
#include "linear/arrays.hpp"
#include "step/add_compensated.hpp"
#include "step/move_driven.hpp"

namespace hbvm::core {

template <Scalar S>
ReducedEquations<S>::ReducedEquations(const Problem<S>& problem)
    : problem_(problem),
      potential_(problem.potential, 1),
      point_(problem),
      force_(Matrix<S>::Zero(1, problem.m())),
      velocity_(Vector<S>::Zero(problem.m())),
      total_(velocity_),
      parts_{{"velocities"}} {
  parts_[velocities].per_call = problem.mass.operations();
  parts_[velocities].per_call.add(Op::add, problem.m());
  if (problem.nu() > 0) parts_.push_back({"constraint forces"});
}

template <Scalar S>
void ReducedEquations<S>::evaluate(const Vector<S>& q, const Vector<S>& p) {
  if (problem_.is_conservative())
    potential_.force(lanes(q), force_);
  else
    point_.set_applied(q, p, force_);
  {
    const PartCall counted(parts_[velocities]);
    point_.set_velocity(q, p, velocity_);
    for (Index j = 0; j < total_.size(); ++j) set(total_[j], force_(0, j));
  }
  if (problem_.nu() > 0) {
    const PartCall counted(parts_[pulls]);
    try {
      const Vector<S>& pull = point_.constraint_force(q, p, force_);
      for (Index j = 0; j < total_.size(); ++j) set_sum(total_[j], total_[j], pull[j]);
    } catch (const IntegrationError& error) {
      throw StageFailure(FailureCause::near_singular_constraints, error.what(), "0", 0);
    }
  }
  for (Index j = 0; j < total_.size(); ++j)
    if (!is_finite(total_[j]) || !is_finite(velocity_[j]))
      throw StageFailure(FailureCause::stage_equations_diverge, "a stage is not finite", "inf", 0);
}

template <Scalar S>
ReducedStepper<S>::ReducedStepper(const Problem<S>& problem)
    : dq_(Vector<S>::Zero(problem.m())),
      dp_(dq_),
      problem_(problem),
      equations_(problem),
      q0_(dq_),
      p0_(dq_),
      q_(dq_),
      p_(dq_),
      velocity_(dq_),
      force_(dq_),
      multiplier_(Vector<S>::Zero(problem.nu())),
      before_(dq_, dq_),
      arrival_(problem, 1) {}

template <Scalar S>
void ReducedStepper<S>::remember_own(Archive& archive) {
  archive(q0_, p0_, velocity_, force_, started_);
  remember_parts(archive);
}

template <Scalar S>
const ReducedEquations<S>& ReducedStepper<S>::evaluate() {
  for (Index j = 0; j < q_.size(); ++j) {
    set_sum(q_[j], q0_[j], dq_[j]);
    set_sum(p_[j], p0_[j], dp_[j]);
  }
  equations_.evaluate(q_, p_);
  return equations_;
}

template <Scalar S>
void ReducedStepper<S>::arrive(const Vector<S>& q, const Vector<S>& p) {
  if (started_ && q == q0_ && p == p0_) return;
  started_ = false;
  equations_.evaluate(q, p);
  set(q0_, q);
  set(p0_, p);
  set(velocity_, equations_.velocity());
  set(force_, equations_.force());
  started_ = true;
}

template <Scalar S>
StepResult<S> ReducedStepper<S>::step(State<S>& state, const S& h) {
  long parts = 0;
  copy_state(before_, state);
  try {
    arrive(state.q, state.p);
    parts = advance(h);
    for (Index j = problem_.clock(); j < q_.size(); ++j) set_zero(dq_[j]);
    for (Index j = 0; j < q_.size(); ++j) {
      if (!is_finite(dq_[j]) || !is_finite(dp_[j]))
        throw StageFailure(FailureCause::stage_equations_diverge, "a step is not finite", "inf", 0);
      add_compensated(state.q[j], state.q_carry[j], dq_[j], s_, t_);
      add_compensated(state.p[j], state.p_carry[j], dp_[j], s_, t_);
    }
    move_driven(state, h, arrival_, problem_);
    arrive(state.q, state.p);
  } catch (const StageFailure& failure) {
    copy_state(state, before_);
    throw StageFailure(failure.cause(), failure.what(), failure.increment(), std::max(parts, failure.sweeps()));
  }
  if (problem_.nu() > 0) set(multiplier_, equations_.multiplier());
  return {parts, &multiplier_};
}

#define HBVM_DEFINE(S)                \
  template class ReducedEquations<S>; \
  template class ReducedStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
