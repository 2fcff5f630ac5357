#include "step/hbvm_stepper.hpp"

#include "scalar/in_place.hpp"
#include "step/add_compensated.hpp"
#include "step/move_driven.hpp"

namespace hbvm::core {

template <Scalar S>
HbvmStepper<S>::HbvmStepper(const Problem<S>& problem, const Hbvm<S>& method, SolverKind solver)
    : problem_(problem),
      method_(method),
      solver_(make_solver(solver, problem, method)),
      multiplier_(Vector<S>::Zero(problem.nu())),
      arrival_(problem, 1) {
  // Two exact sums and one a coordinate of q and p, one of carries.
  update_.per_call.add(Op::add, problem.m() * (2 * 5 + 1));
  update_.per_call.add(Op::subtract, problem.m() * 2 * 8);
  update_.per_call.add_products(problem.nu() * method.s);
}

template <Scalar S>
StepResult<S> HbvmStepper<S>::step(State<S>& state, const S& h) {
  const long sweeps = solver_->solve({state.q, state.p, h, &state.q_carry, &state.p_carry});
  const StageUnknowns<S>& x = solver_->unknowns();
  const StepChange<S>& change = solver_->change();
  const PartCall counted(update_);
  HeldScratch<S> s = s_, t = t_;
  move_driven(state, h, arrival_, problem_);
  for (Index j = 0; j < problem_.mass.of_bodies(); ++j) {
    add_compensated(state.q[j], state.q_carry[j], change.q[j], s, t);
    set_sum(state.p_carry[j], state.p_carry[j], change.p_rest[j]);
    add_compensated(state.p[j], state.p_carry[j], change.p[j], s, t);
  }
  for (Index j = problem_.clock(); j < problem_.m(); ++j)
    add_compensated(state.p[j], state.p_carry[j], change.p[j], s, t);
  for (Index a = 0; a < problem_.nu(); ++a) {
    set_zero(multiplier_[a]);
    for (Index i = 0; i < method_.s; ++i) add_product(multiplier_[a], method_.lambda_at_1[i], x.lambda(i, a), t_);
  }
  return {sweeps, &multiplier_, &x};
}

template <Scalar S>
SolverCounts HbvmStepper<S>::own_counts() const {
  SolverCounts now = solver_->counts();
  now.parts.push_back(update_);
  return now;
}

template <Scalar S>
void HbvmStepper<S>::remember_own(Archive& archive) {
  archive(*solver_);
}

#define HBVM_DEFINE(S) template class HbvmStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
