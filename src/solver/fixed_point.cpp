#include "solver/fixed_point.hpp"

#include "linear/arrays.hpp"
#include "problem/regularity.hpp"
#include "scalar/in_place.hpp"
#include "scalar/text.hpp"
#include "solver/roundings.hpp"

namespace hbvm::core {

template <Scalar S>
FixedPoint<S>::FixedPoint(const Problem<S>& problem, const Hbvm<S>& method, Order order)
    : equations_(problem, method),
      order_(order),
      x_(equations_.make_unknowns()),
      gamma_before_(x_.gamma),
      psi_before_(x_.psi),
      extrapolation_(x_.gamma.rows(), x_.gamma.cols()),
      position_scale_(problem),
      rule_(problem.m(), roundings_of_a_sweep(problem, method)),
      root_check_(problem, method),
      positions_(problem.m()),
      change_(problem.m()) {
  start_count_.per_call = extrapolation_.operations();
  increment_count_.per_call.add(Op::subtract, x_.gamma.size() * (order == Order::paper ? 2 : 1));
}

template <Scalar S>
SolverCounts FixedPoint<S>::counts() const {
  SolverCounts all{equations_.effect_counts(), equations_.part_counts()};
  all.parts.insert(all.parts.end(), {start_count_, increment_count_});
  return all;
}

template <Scalar S>
std::vector<PartCount> FixedPoint<S>::counts_in_double() const {
  const SolverCounts all = counts();
  std::vector<PartCount> parts;
  const auto& terms = equations_.problem().potential.terms;
  for (std::size_t t = 0; t < all.effects.size(); ++t) {
    if (t < terms.size() && terms[t].constant_force) continue;
    const EffectCount& effect = all.effects[t];
    parts.push_back(
        {.name = "effects", .calls = effect.evaluations, .per_call = effect.done(), .seconds = effect.seconds});
  }
  parts.insert(parts.end(), all.parts.begin(), all.parts.end());
  for (PartCount& part : parts) part.in_double = true;
  return parts;
}

template <Scalar S>
long FixedPoint<S>::solve(const StepStart<S>& start) {
  if (start.h != h_) {
    set(h_, start.h);
    extrapolation_.clear();
  }
  equations_.start(start);
  position_scale_.evaluate(start.q, h_, positions_);
  long sweeps = 0;
  bool doubtful = false;
  if (order_ == Order::paper) {
    prepare(Start::zero, start.p);
    sweeps = iterate();
  } else {
    if (!extrapolation_.empty()) {
      try {
        extrapolation_.predict(x_.gamma.data());
        sweeps = iterate();
      } catch (const StageFailure& failure) {
        sweeps = failure.sweeps();
        extrapolation_.clear();
        doubtful = true;
      }
    }
    if (extrapolation_.empty()) {
      prepare(Start::constant, start.p);
      sweeps += iterate();
    }
  }
  if (doubtful || rule_.sweeps() > significand_bits<S>()) sweeps += check_root(sweeps);
  if (order_ == Order::newest) {
    const PartCall counted(start_count_);
    extrapolation_.add(x_.gamma.data());
  }
  equations_.changes(x_, change_);
  return sweeps;
}

template <Scalar S>
void FixedPoint<S>::prepare(Start start, const Vector<S>& p0) {
  for (Matrix<S>* unknown : {&x_.gamma, &x_.psi, &x_.zeta, &x_.lambda}) set_zero(*unknown);
  if (start == Start::constant)
    for (Index j = 0; j < x_.gamma.cols(); ++j) set(x_.gamma(0, j), p0[j]);
}

template <Scalar S>
bool FixedPoint<S>::sweep(bool factor) {
  const bool papers = order_ == Order::paper;
  std::swap(gamma_before_, x_.gamma);
  if (papers) std::swap(psi_before_, x_.psi);
  equations_.move(gamma_before_);
  equations_.forces(x_.psi);
  const Matrix<S>& psi = papers ? psi_before_ : x_.psi;
  if (!equations_.multipliers(psi, x_.lambda, x_.zeta, factor)) return false;
  equations_.momenta(psi, x_.zeta, x_.gamma);
  return true;
}

template <Scalar S>
bool FixedPoint<S>::conditioned() {
  if (x_.lambda.size() == 0) return false;
  const double kappa = angle_condition(equations_.problem(), equations_.q0());
  if (!(rule_.condition_wanted() <= kappa)) return false;
  rule_.set_condition(kappa);
  return true;
}

template <Scalar S>
long FixedPoint<S>::check_root(long sweeps) {
  using Verdict = typename RootCheck<S>::Verdict;
  const Verdict verdict = root_check_.judge({equations_.q0(), equations_.p0(), h_}, x_.gamma);
  if (verdict == Verdict::other || verdict == Verdict::lost) {
    extrapolation_.clear();
    throw StageFailure(FailureCause::stage_equations_diverge,
                       verdict == Verdict::other ? "the solution found is not the one that shorter steps lead to"
                                                 : "the solution found cannot be followed from shorter steps",
                       to_scientific(rule_.relative_change(), 3), sweeps + root_check_.sweeps());
  }
  return root_check_.sweeps();
}

template <Scalar S>
long FixedPoint<S>::iterate() {
  using Verdict = typename StoppingRule<S>::Verdict;
  const bool papers = order_ == Order::paper;
  rule_.start(equations_.p0(), positions_);
  for (;;) {
    // The matrix of (29) at nodes near the solution serves all sweeps: it multiplies a change that goes to 0.
    if (!sweep(papers || rule_.is_coarse()))
      throw StageFailure(FailureCause::near_singular_constraints,
                         "the linear system for the multipliers, (29), is singular", "0", rule_.sweeps() + 1);
    const PartCall counted(increment_count_);
    rule_.show_change(x_.gamma, gamma_before_);
    if (papers) rule_.show_change(x_.psi, psi_before_, &h_);
    if (rule_.is_coarse()) {
      rule_.show_terms(x_.gamma);
      rule_.show_terms(x_.psi, &h_);
    }
    const Verdict verdict = rule_.judge();
    if (verdict == Verdict::converged) return rule_.sweeps();
    if (verdict == Verdict::go_on || (verdict == Verdict::stagnant && conditioned())) continue;
    throw rule_.failure(verdict);
  }
}

#define HBVM_DEFINE(S) template class FixedPoint<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
