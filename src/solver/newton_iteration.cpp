#include "solver/newton_iteration.hpp"

#include "linear/arrays.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"
#include "scalar/text.hpp"
#include "solver/roundings.hpp"

namespace hbvm::core {
namespace {

/// Jacobians that cost up to so many sweeps are cheap: for a solution, and for a start that is corrected anyway. A
/// cheap Jacobian is evaluated anew instead of updated.
constexpr double cheap = 16, cheap_for_a_start = 8;

/// The cost of a Jacobian, in sweeps.
template <Scalar S>
double evaluation_in_sweeps(const Jacobian<S>& jacobian, const StageEquations<S>& equations) {
  return static_cast<double>(jacobian.evaluation_cost()) /
         static_cast<double>(equations.residual_operations().total() + jacobian.solution_cost());
}

}  // namespace

template <Scalar S>
NewtonIteration<S>::NewtonIteration(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted)
    : wanted_(wanted),
      equations_(problem, method),
      jacobian_(problem, method),
      x_(equations_.make_unknowns()),
      start_(x_),
      residual_{x_.gamma, x_.lambda},
      momentum_(x_.gamma),
      updates_(residual_,
               evaluation_in_sweeps(jacobian_, equations_) > (wanted == Wanted::start ? cheap_for_a_start : cheap)),
      base_{x_.gamma, x_.lambda},
      correction_(base_),
      base_scale_(problem),
      momentum_change_(method),
      step_change_(problem.m()),
      position_scale_(problem),
      positions_(problem.m()),
      rule_(problem.m(), roundings_of_a_sweep(problem, method)),
      // Some to come near, then three bits a sweep: less is slow.
      max_sweeps_(60 + significand_bits<S>() / 3),
      course_(S(roundings_of_a_sweep(problem, method)) * epsilon<S>(), evaluation_in_sweeps(jacobian_, equations_),
              updates_.used()) {
  equations_count_.per_call = equations_.residual_operations();
  // x = base - factor correction, with h lambda for lambda.
  increment_count_.per_call.add(Op::multiply, x_.gamma.size() + x_.lambda.size());
  increment_count_.per_call.add(Op::subtract, x_.gamma.size() + x_.lambda.size());
  increment_count_.per_call.add(Op::reciprocal, x_.lambda.size());
}

template <Scalar S>
void NewtonIteration<S>::begin(const StepStart<S>& from, const S& h) {
  equations_.start({from.q, from.p, h, from.q_carry, from.p_carry});
  position_scale_.evaluate(from.q, h, positions_);
}

template <Scalar S>
bool NewtonIteration<S>::evaluate_jacobian() {
  usable_ = jacobian_.factor(equations_, x_.lambda);
  return usable_;
}

template <Scalar S>
void NewtonIteration<S>::fail(FailureCause cause, const char* what, long sweep) const {
  throw StageFailure(cause, what, to_scientific(rule_.relative_change(), 3), sweep);
}

template <Scalar S>
long NewtonIteration<S>::run() {
  course_.start(!usable_);
  updates_.clear();
  rule_.start(equations_.p0(), positions_);
  for (long sweep = 1; sweep <= max_sweeps_; ++sweep) {
    evaluate_residual(sweep);
    if (course_.evaluates()) {
      if (!evaluate_jacobian())
        fail(FailureCause::near_singular_constraints, "the Jacobian of the stage equations is singular", sweep);
      updates_.clear();
    }
    jacobian_.solve(residual_);
    const PartCall counted(increment_count_);
    const Verdict verdict = find_correction();
    if (course_.begins()) {
      if (verdict == Verdict::not_finite)
        fail(FailureCause::stage_equations_diverge, "an iterate is not finite", sweep);
      base_scale_.keep(rule_);
    }
    base_scale_.measure(residual_.momentum, rule_, course_.change());
    if (course_.went_too_far()) {
      step_back(sweep);
      continue;
    }
    step_on();
    if (is_solution(verdict)) {
      equations_.changes(x_, step_change_);
      momentum_change_.add(momentum_, residual_.momentum, step_change_.p_rest);
      return sweep;
    }
    course_.go_on(sweep);
    base_scale_.keep(rule_);
  }
  fail(FailureCause::stage_equations_diverge, "the increments stagnate", max_sweeps_);
}

template <Scalar S>
void NewtonIteration<S>::evaluate_residual(long sweep) {
  {
    const PartCall counted(equations_count_);
    equations_.residual(x_, residual_);
  }
  set(momentum_, residual_.momentum);
  if (sweep == 1) set(start_, x_);
}

template <Scalar S>
typename NewtonIteration<S>::Verdict NewtonIteration<S>::find_correction() {
  updates_.update(residual_, base_scale_.of_coordinates());
  rule_.show_change(residual_.momentum);
  rule_.show_terms(x_.gamma);
  rule_.show_terms(x_.psi, &equations_.step());
  return rule_.judge();
}

template <Scalar S>
void NewtonIteration<S>::step_back(long sweep) {
  if (course_.is_exact()) {
    const int halvings = course_.halve();
    if (halvings == 0)
      fail(FailureCause::stage_equations_diverge,
           is_finite(course_.change()) ? "the increments grow" : "an iterate is not finite", sweep);
    move_from_base(power_of_two<S>(-halvings));
    updates_.clear();
    return;
  }
  move_from_base(S(0));
  rule_.start(equations_.p0(), positions_);
  course_.take_back();
}

template <Scalar S>
void NewtonIteration<S>::step_on() {
  set(base_.momentum, x_.gamma);
  set(base_.constraint, x_.lambda);
  set(correction_.momentum, residual_.momentum);
  set(correction_.constraint, residual_.constraint);
  move_from_base(S(1));
  updates_.keep(correction_, base_scale_.of_coordinates(), course_.is_rounding());
}

template <Scalar S>
bool NewtonIteration<S>::is_solution(Verdict verdict) {
  // Of few stages the sweeps that make a start as good as it gets cost nothing beside one in more digits.
  const bool enough = wanted_ == Wanted::start && course_.is_rounding() && updates_.used();
  // A residual as large as what it is the residual of shows no solution, however small the increments.
  return (verdict == Verdict::converged || course_.is_on_floor() || enough) &&
         base_scale_.leaves_little(momentum_, rule_);
}

template <Scalar S>
void NewtonIteration<S>::move_from_base(const S& factor) {
  for (Index i = 0; i < x_.gamma.size(); ++i) {
    set_product(t_, correction_.momentum.data()[i], factor);
    set_difference(x_.gamma.data()[i], base_.momentum.data()[i], t_);
  }
  for (Index i = 0; i < x_.lambda.size(); ++i) {
    set_product(t_, correction_.constraint.data()[i], factor);
    set_quotient(t_, t_, equations_.step());
    set_difference(x_.lambda.data()[i], base_.constraint.data()[i], t_);
  }
}

#define HBVM_DEFINE(S) template class NewtonIteration<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
