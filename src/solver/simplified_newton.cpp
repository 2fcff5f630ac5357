#include "solver/simplified_newton.hpp"

#include <cmath>

#include "interruption.hpp"
#include "linear/arrays.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"
#include "scalar/text.hpp"
#include "solver/roundings.hpp"

namespace hbvm::core {
namespace {

/// Increments that fall by less than this a sweep may be worth a new Jacobian.
constexpr int slow = 10;

/// Corrections that are kept: with as many updates the Jacobian is as good as a new one if updates make it so.
constexpr std::size_t most_kept = 16;

/// Jacobians that cost as much as so many sweeps are cheap: where errors of the solution add up over steps, and where
/// it is a start that is corrected anyway.
constexpr double cheap = 16, cheap_for_a_start = 8;

/// Of each coordinate.
template <Scalar S>
std::vector<Index> bodies_of(const Problem<S>& problem) {
  std::vector<Index> bodies;
  Index body = 0;
  for (const auto& block : problem.mass.blocks())
    bodies.insert(bodies.end(), static_cast<std::size_t>(block.size), body++);
  return bodies;
}

/// Row 0 of X^-1.
template <Scalar S>
Vector<S> first_row_of_inverse(const Matrix<S>& X) {
  Lu<S> lu;
  lu.set(X.transpose());
  Vector<S> row = Vector<S>::Unit(X.rows(), 0);
  if (!lu.factor()) throw InputError("X_s is singular");
  lu.solve(row);
  return row;
}

}  // namespace

template <Scalar S>
SimplifiedNewton<S>::SimplifiedNewton(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted)
    : problem_(problem),
      method_(method),
      wanted_(wanted),
      equations_(problem, method),
      jacobian_(problem, method),
      x_(equations_.make_unknowns()),
      residual_{x_.gamma, x_.lambda},
      momentum_(x_.gamma),
      start_(x_),
      base_{x_.gamma, x_.lambda},
      correction_(base_),
      base_scale_(problem.m()),
      start_size_(problem.m()),
      first_row_of_inverse_X_(first_row_of_inverse(method.X_s)),
      sequence_(x_.gamma.size() + x_.lambda.size()),
      step_change_(problem.m()),
      extrapolation_(method.s, problem.m() + problem.nu()),
      continuation_(method, bodies_of(problem), problem.nu()),
      position_scale_(problem),
      positions_(problem.m()),
      rule_(problem.m(), roundings_of_a_sweep(problem, method)),
      // Some to come near, then three bits a sweep: less is `slow`.
      max_sweeps_(60 + significand_bits<S>() / 3) {
  using std::sqrt;
  tolerance_ = S(roundings_of_a_sweep(problem, method)) * epsilon<S>();
  root_epsilon_ = sqrt(epsilon<S>());
  coarse_ = power_of_two<S>(-10);
  equations_count_.per_call = equations_.residual_operations();
  sweeps_an_evaluation_ = static_cast<double>(jacobian_.evaluation_cost()) /
                          static_cast<double>(equations_count_.per_call.total() + jacobian_.solution_cost());
  // A cheap Jacobian is evaluated anew instead.
  const bool for_more_digits = wanted_ == Wanted::start;
  if (sweeps_an_evaluation_ > (for_more_digits ? cheap_for_a_start : cheap)) {
    kept_.assign(most_kept, residual_);
    squares_.assign(most_kept, S(0));
  }
  start_count_.per_call = extrapolation_.operations();
  // x = base - factor correction, with h lambda for lambda.
  increment_count_.per_call.add(Op::multiply, x_.gamma.size() + x_.lambda.size());
  increment_count_.per_call.add(Op::subtract, x_.gamma.size() + x_.lambda.size());
  increment_count_.per_call.add(Op::reciprocal, x_.lambda.size());
}

template <Scalar S>
SolverCounts SimplifiedNewton<S>::counts() const {
  SolverCounts all{equations_.effect_counts(), equations_.part_counts()};
  const std::vector<PartCount>& jacobian = jacobian_.part_counts();
  all.parts.insert(all.parts.end(), jacobian.begin(), jacobian.end());
  all.parts.insert(all.parts.end(), {start_count_, continuation_.part_count(), increment_count_});
  return all;
}

template <Scalar S>
std::vector<PartCount> SimplifiedNewton<S>::counts_in_double() const {
  std::vector<PartCount> parts{equations_count_};
  const std::vector<PartCount>& jacobian = jacobian_.part_counts();
  parts.insert(parts.end(), jacobian.begin(), jacobian.end());
  parts.insert(parts.end(), {start_count_, continuation_.part_count(), increment_count_});
  for (PartCount& part : parts) part.in_double = true;
  return parts;
}

template <Scalar S>
void SimplifiedNewton<S>::measure_time() {
  equations_.measure_time();
  measure_time_in_double();
}

template <Scalar S>
void SimplifiedNewton<S>::measure_time_in_double() {
  timed_ = true;
  continuation_.measure_time();
  jacobian_.measure_time();
}

template <Scalar S>
void SimplifiedNewton<S>::begin(const StepStart<S>& from, const S& h) {
  equations_.start({from.q, from.p, h, from.q_carry, from.p_carry});
  position_scale_.evaluate(from.q, h, positions_);
}

template <Scalar S>
long SimplifiedNewton<S>::solve(const StepStart<S>& from) {
  if (from.h != h_) {
    set(h_, from.h);
    extrapolation_.clear();
    continuation_.clear();
    usable_ = false;
  }
  begin(from, h_);
  long sweeps = 0;
  const auto attempt = [&](Start start) {
    try {
      if (start == Start::shorter || start == Start::shortest) {
        sweeps += grow(from, start == Start::shorter ? 12 : 30);
        usable_ = false;
      } else {
        prepare(start, from.p);
      }
      set(start_.gamma, x_.gamma);
      sweeps += iterate();
      if (start == Start::shorter || start == Start::shortest) return true;
      keep_start_size();
      return !is_far_from_start() && !multipliers_run_wild();
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      usable_ = false;
      if (start == Start::shortest) throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps);
      return false;
    }
  };
  if (extrapolation_.empty() || !attempt(Start::previous))
    if (!attempt(Start::constant) && !attempt(Start::shorter)) attempt(Start::shortest);
  const PartCall counted(start_count_, timed_);
  set(sequence_, x_.gamma);
  for (Index i = 0; i < x_.lambda.size(); ++i) set(sequence_[x_.gamma.size() + i], x_.lambda.data()[i]);
  extrapolation_.add(sequence_.data());
  continuation_.keep(x_);
  return sweeps;
}

template <Scalar S>
long SimplifiedNewton<S>::follow(const StepStart<S>& from) {
  set(h_, from.h);
  usable_ = false;
  long sweeps = 0;
  for (const int halvings : {12, 30}) {
    try {
      sweeps += grow(from, halvings);
      break;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      if (halvings == 30) throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps);
    }
  }
  return sweeps;
}

template <Scalar S>
void SimplifiedNewton<S>::keep_start_size() {
  const S& h = equations_.step();
  for (const auto& block : problem_.mass.blocks()) {
    S size = 0;
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      raise_magnitude(size, equations_.p0()[j]);
      for (Index i = 0; i < start_.psi.rows(); ++i) {
        raise_magnitude(size, S(h * start_.psi(i, j)));
        raise_magnitude(size, S(h * start_.zeta(i, j)));
      }
    }
    for (Index j = block.offset; j < block.offset + block.size; ++j) set(start_size_[j], size);
  }
}

template <Scalar S>
bool SimplifiedNewton<S>::is_far_from_start() const {
  // Body by body: a coordinate may be small for a moment.
  for (const auto& block : problem_.mass.blocks()) {
    S moved = 0, forces_changed = 0;
    for (Index j = block.offset; j < block.offset + block.size; ++j)
      for (Index i = 0; i < start_.gamma.rows(); ++i) {
        raise_magnitude(moved, S(x_.gamma(i, j) - start_.gamma(i, j)));
        raise_magnitude(forces_changed, S(equations_.step() * (x_.psi(i, j) - start_.psi(i, j))));
      }
    const S& size = start_size_[block.offset];
    if (moved > size || 2 * forces_changed > size) return true;
  }
  return false;
}

template <Scalar S>
bool SimplifiedNewton<S>::multipliers_run_wild() const {
  constexpr int much = 4;
  const ConstraintGradient<S>& gradient = equations_.constraint_gradient();
  const auto change_at_node = [&](Index i, Index a) {
    if (!method_.has_coefficients_of_lambda()) return S(x_.lambda(i, a) - start_.lambda(i, a));
    S sum = 0;
    for (Index l = 0; l < method_.s; ++l) sum += method_.P_s(i, l) * (x_.lambda(l, a) - start_.lambda(l, a));
    return sum;
  };
  for (Index a = 0; a < x_.lambda.cols(); ++a) {
    const auto& pattern = gradient.pattern(a);
    for (std::size_t c = 0; c < pattern.coordinates.size(); ++c) {
      const Index column = pattern.first + static_cast<Index>(c);
      const S most = much * start_size_[pattern.coordinates[c]];
      for (Index i = 0; i < method_.r; ++i)
        if (!(magnitude(S(equations_.step() * gradient.values()(i, column) * change_at_node(i, a))) <= most))
          return true;
    }
  }
  return false;
}

template <Scalar S>
bool SimplifiedNewton<S>::continuation_is_nearer() const {
  // Errors of the momenta of some body, over their size.
  long continued = exponent_of_zero, extrapolated = exponent_of_zero;
  for (const auto& block : problem_.mass.blocks()) {
    long size = exponent_of_zero, a = exponent_of_zero, b = exponent_of_zero;
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      size = std::max(size, continuation_.size_exponent(j));
      a = std::max(a, continuation_.error_exponent(j));
      b = std::max(b, extrapolation_.error_exponent(j));
    }
    if (size == exponent_of_zero) continue;
    continued = std::max(continued, a - size);
    extrapolated = std::max(extrapolated, b - size);
  }
  return continued < extrapolated;
}

template <Scalar S>
void SimplifiedNewton<S>::prepare(Start start, const Vector<S>& p0) {
  if (start == Start::previous) {
    if (continuation_is_nearer()) return continuation_.predict(x_);
    extrapolation_.predict(sequence_.data());
    for (Index i = 0; i < x_.gamma.size(); ++i) set(x_.gamma.data()[i], sequence_[i]);
    for (Index i = 0; i < x_.lambda.size(); ++i) set(x_.lambda.data()[i], sequence_[x_.gamma.size() + i]);
    return;
  }
  set_zero(x_.gamma);
  set_zero(x_.lambda);
  for (Index j = 0; j < p0.size(); ++j) set(x_.gamma(0, j), p0[j]);
  // The multipliers of these positions, as a sweep of the fixed-point iteration has them.
  equations_.move(x_.gamma);
  equations_.forces(x_.psi);
  if (!equations_.multipliers(x_.psi, x_.lambda, x_.zeta)) set_zero(x_.lambda);
}

template <Scalar S>
long SimplifiedNewton<S>::grow(const StepStart<S>& from, int halvings) {
  // Steps grow by factors of 1 + growth.
  constexpr int least_growth_bits = 6;
  S h = h_ * power_of_two<S>(-halvings), growth = 1;
  long sweeps = 0;
  Matrix<S> gamma, lambda;  // of the last step that was solved
  // The multipliers, too, are those of the shortest step: of a body at rest they tell how far it may move.
  begin(from, h);
  prepare(Start::constant, from.p);
  for (bool first = true;; first = false) {
    // There may be a thousand shorter steps.
    if (!first) end_if_asked("the solution was not followed from shorter steps");
    try {
      begin(from, h);
      usable_ = false;
      set(start_.gamma, x_.gamma);
      sweeps += iterate();
      if (first) keep_start_size();
      if (first && is_far_from_start())
        throw StageFailure(FailureCause::stage_equations_diverge,
                           "even much shorter steps have no solution near their start", "1", sweeps);
      if (!(h < h_)) return sweeps;
      gamma = x_.gamma;
      lambda = x_.lambda;
      if (growth < 1) growth = 2 * growth;
    } catch (const StageFailure& failure) {
      growth = growth / 2;
      if (first || growth < power_of_two<S>(-least_growth_bits))
        throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps + failure.sweeps());
      sweeps += failure.sweeps();
      h = solved_;
    }
    solved_ = h;
    h = h * (1 + growth);
    if (!(h < h_)) h = h_;
    x_.lambda = lambda;
    // The degree j of v grows with the step to the power j.
    S power = 1;
    for (Index j = 0; j < method_.s; ++j) {
      for (Index i = 0; i < x_.gamma.cols(); ++i) x_.gamma(j, i) = gamma(j, i) * power;
      power = power * (h / solved_);
    }
  }
}

template <Scalar S>
void SimplifiedNewton<S>::move_from_base(const S& h, const S& factor) {
  for (Index i = 0; i < x_.gamma.size(); ++i) {
    set_product(t_, correction_.momentum.data()[i], factor);
    set_difference(x_.gamma.data()[i], base_.momentum.data()[i], t_);
  }
  for (Index i = 0; i < x_.lambda.size(); ++i) {
    set_product(t_, correction_.constraint.data()[i], factor);
    set_quotient(t_, t_, h);
    set_difference(x_.lambda.data()[i], base_.constraint.data()[i], t_);
  }
}

template <Scalar S>
S SimplifiedNewton<S>::product(const StageResidual<S>& a, const StageResidual<S>& b) {
  S sum = 0;
  for (Index j = 0; j < a.momentum.cols(); ++j) {
    if (base_scale_[j] == 0) continue;
    set_zero(u_);
    for (Index i = 0; i < a.momentum.rows(); ++i) {
      set_quotient(t_, a.momentum(i, j), base_scale_[j]);
      set_product(t_, t_, b.momentum(i, j));
      set_sum(u_, u_, t_);
    }
    set_quotient(u_, u_, base_scale_[j]);
    set_sum(sum, sum, u_);
  }
  return sum;
}

template <Scalar S>
void SimplifiedNewton<S>::update_correction() {
  const auto add = [&](const S& factor, const StageResidual<S>& other) {
    for (Index i = 0; i < x_.gamma.size(); ++i)
      add_product(residual_.momentum.data()[i], factor, other.momentum.data()[i], t_);
    for (Index i = 0; i < x_.lambda.size(); ++i)
      add_product(residual_.constraint.data()[i], factor, other.constraint.data()[i], t_);
  };
  for (std::size_t n = 0; n + 1 < known_; ++n) add(S(product(kept_[n], residual_) / squares_[n]), kept_[n + 1]);
  if (known_ == 0) return;
  // An update that turns it round, or makes it many times as long, is none.
  const S ratio = product(kept_[known_ - 1], residual_) / squares_[known_ - 1];
  if (!(4 * magnitude(ratio) <= 3)) return;
  const S factor = 1 / (1 - ratio);
  set_product(residual_.momentum, factor, residual_.momentum);
  set_product(residual_.constraint, factor, residual_.constraint);
}

template <Scalar S>
void SimplifiedNewton<S>::keep_correction(bool small) {
  if (small || known_ == kept_.size()) known_ = 0;
  if (small || kept_.empty()) return;
  StageResidual<S>& kept = kept_[known_];
  set(kept.momentum, correction_.momentum);
  set(kept.constraint, correction_.constraint);
  set(squares_[known_], product(kept, kept));
  if (squares_[known_] > 0) ++known_;
}

template <Scalar S>
void SimplifiedNewton<S>::keep_base_scale() {
  for (const auto& block : problem_.mass.blocks()) {
    set_zero(t_);
    for (Index j = block.offset; j < block.offset + block.size; ++j) raise_magnitude(t_, rule_.scale(j));
    for (Index j = block.offset; j < block.offset + block.size; ++j) set(base_scale_[j], t_);
  }
}

template <Scalar S>
void SimplifiedNewton<S>::measure_change() {
  set_zero(change_);
  for (Index j = 0; j < base_scale_.size(); ++j) {
    set_zero(t_);
    for (Index i = 0; i < residual_.momentum.rows(); ++i) raise_magnitude(t_, residual_.momentum(i, j));
    if (t_ == 0) continue;
    set_quotient(t_, t_, base_scale_[j] == 0 ? rule_.scale(j) : base_scale_[j]);
    raise_magnitude(change_, t_);
  }
}

template <Scalar S>
bool SimplifiedNewton<S>::evaluation_pays(bool fresh) const {
  if (kept_.empty()) return true;
  // No patience where they do not fall at all: it may be rounding, which shows by the Jacobian of the iterate itself.
  if (change_ <= coarse_ && (fresh ? !(2 * change_ < last_) : rises_ > 1)) return true;
  // The first falls do not decide: updates come to bear on the next.
  constexpr int undecided = 4;
  if (falls_ < undecided && change_ < 2 * last_) return false;
  // With a new one it takes about two.
  constexpr int sweeps_with_it = 2;
  const double bits = std::log2(approximately(S(change_ / tolerance_)));
  const double bits_a_sweep = falls_ > 0 ? std::log2(approximately(S(first_ / change_))) / falls_
                                         : std::log2(approximately(S(last_ / change_)));
  return !(bits <= (sweeps_an_evaluation_ + sweeps_with_it) * bits_a_sweep);
}

template <Scalar S>
bool SimplifiedNewton<S>::residual_is_small() {
  for (const auto& block : problem_.mass.blocks()) {
    set_zero(t_);
    set_zero(u_);
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      raise_magnitude(u_, rule_.scale(j));
      for (Index i = 0; i < momentum_.rows(); ++i) raise_magnitude(t_, momentum_(i, j));
    }
    if (16 * t_ > u_) return false;
  }
  return true;
}

template <Scalar S>
long SimplifiedNewton<S>::iterate() {
  using Verdict = typename StoppingRule<S>::Verdict;
  constexpr int most_halvings = 12;
  const S& h = equations_.step();
  // Whether the Jacobian is to be evaluated at x_; whether it was at base_; how often the step from there was halved.
  bool evaluate = !usable_, exact = false;
  int halvings = 0, waiting = 0;
  long small = 0;
  set_zero(last_);
  known_ = 0;
  rises_ = 0;
  rule_.start(equations_.p0(), positions_);
  for (long sweeps = 1; sweeps <= max_sweeps_; ++sweeps) {
    const auto fail = [&](FailureCause cause, const char* what) {
      throw StageFailure(cause, what, to_scientific(rule_.relative_change(), 3), sweeps);
    };
    {
      const PartCall counted(equations_count_, timed_);
      equations_.residual(x_, residual_);
    }
    set(momentum_, residual_.momentum);
    if (sweeps == 1) {
      set(start_.lambda, x_.lambda);
      set(start_.psi, x_.psi);
      set(start_.zeta, x_.zeta);
    }
    if (evaluate) {
      if (!jacobian_.factor(equations_, x_.lambda))
        fail(FailureCause::near_singular_constraints, "the Jacobian of the stage equations is singular");
      usable_ = true;
      known_ = 0;
    }
    jacobian_.solve(residual_);
    const PartCall counted(increment_count_, timed_);
    update_correction();
    rule_.show_change(residual_.momentum);
    rule_.show_terms(x_.gamma);
    rule_.show_terms(x_.psi, &h);
    const Verdict verdict = rule_.judge();

    if (last_ > 0) {
      measure_change();
      // An expensive Jacobian of another step may be updated to one with which they fall.
      const bool patient = !exact && !kept_.empty();
      const bool too_far = !(change_ < (patient ? S(2 * last_) : last_)) && !(change_ <= coarse_);
      if (too_far && exact) {
        if (++halvings > most_halvings)
          fail(FailureCause::stage_equations_diverge,
               is_finite(change_) ? "the increments grow" : "an iterate is not finite");
        move_from_base(h, power_of_two<S>(-halvings));
        known_ = 0;
        evaluate = false;
        continue;
      }
      if (too_far) {
        // The Jacobian is an old one.
        move_from_base(h, S(0));
        rule_.start(equations_.p0(), positions_);
        set_zero(last_);
        evaluate = true;
        continue;
      }
    } else if (verdict == Verdict::not_finite) {
      fail(FailureCause::stage_equations_diverge, "an iterate is not finite");
    } else {
      keep_base_scale();
      measure_change();
    }
    set(base_.momentum, x_.gamma);
    set(base_.constraint, x_.lambda);
    set(correction_.momentum, residual_.momentum);
    set(correction_.constraint, residual_.constraint);
    move_from_base(h, S(1));
    const bool is_rounding = change_ <= 16 * epsilon<S>();
    keep_correction(is_rounding);

    // With the Jacobian of the iterate itself, increments that do not fall are rounding, however much an
    // ill-conditioned problem magnifies it; but half of the digits must be left.
    const bool falls = 2 * change_ < last_;
    waiting = last_ > 0 && !falls && evaluate ? waiting + 1 : 0;
    const bool floor = waiting >= 3 && change_ <= root_epsilon_;
    // Of few stages the sweeps that make a start as good as it gets cost nothing beside one in more digits.
    const bool enough = wanted_ == Wanted::start && is_rounding && !kept_.empty();
    if ((verdict == Verdict::converged || floor || enough) && residual_is_small()) {
      equations_.changes(x_, step_change_);
      add_change_of_momentum(momentum_, residual_.momentum, step_change_.p_rest);
      return sweeps;
    }
    exact = evaluate;
    halvings = 0;
    small = change_ > tolerance_ ? 0 : small + 1;
    if (last_ == 0 || evaluate) {
      set(first_, change_);
      falls_ = 0;
    } else {
      ++falls_;
    }
    rises_ = change_ < last_ ? 0 : rises_ + 1;
    // Rounding does not fall, and no new Jacobian mends it, unless there is more of it than there should be.
    evaluate = last_ > 0 && slow * change_ > last_ && (change_ > tolerance_ || (kept_.empty() ? sweeps : small) > 10) &&
               evaluation_pays(exact);
    set(last_, change_);
    keep_base_scale();
  }
  throw StageFailure(FailureCause::stage_equations_diverge, "the increments stagnate",
                     to_scientific(rule_.relative_change(), 3), max_sweeps_);
}

template <Scalar S>
void SimplifiedNewton<S>::add_change_of_momentum(const Matrix<S>& momentum, const Matrix<S>& correction,
                                                 Vector<S>& change) const {
  S t;
  for (Index j = 0; j < change.size(); ++j)
    for (Index i = 0; i < method_.s; ++i)
      add_product(change[j], first_row_of_inverse_X_[i], S(momentum(i, j) - correction(i, j)), t);
}

#define HBVM_DEFINE(S) template class SimplifiedNewton<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
