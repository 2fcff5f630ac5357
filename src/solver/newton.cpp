#include "solver/newton.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "linear/arrays.hpp"
#include "scalar/binary_exponent.hpp"
#include "solver/roundings.hpp"

namespace hbvm::core {
namespace {

/// x 2^-exponent.
template <Scalar S>
double scaled(const S& x, long exponent) {
  if constexpr (std::same_as<S, Mpfr>) {
    long own = 0;
    const double fraction = mpfr_get_d_2exp(&own, raw(x), MPFR_RNDN);
    return own - exponent < -1000 ? 0 : std::ldexp(fraction, static_cast<int>(own - exponent));
  } else {
    using std::ldexp;
    return approximately(S(ldexp(x, static_cast<int>(-exponent))));
  }
}

/// r = y 2^exponent.
template <Scalar S>
void set_scaled(S& r, double y, long exponent) {
  if constexpr (std::same_as<S, Mpfr>) {
    constexpr int bits = std::numeric_limits<double>::digits;
    if (!std::isfinite(y) || bits > std::numeric_limits<long>::digits) {
      mpfr_set_d(raw(r), y, MPFR_RNDN);
      return static_cast<void>(mpfr_mul_2si(raw(r), raw(r), exponent, MPFR_RNDN));
    }
    // As a whole number, which is quicker than mpfr_set_d.
    int own = 0;
    const auto whole = static_cast<long>(std::ldexp(std::frexp(y, &own), bits));
    mpfr_set_si_2exp(raw(r), whole, own - bits + exponent, MPFR_RNDN);
  } else {
    using std::ldexp;
    r = ldexp(S(y), static_cast<int>(exponent));
  }
}

/// Bits that one sweep with a Jacobian in double wins at most, and no fall by more is taken for a rate.
constexpr long bits_per_sweep = 50;
/// Bits that a residual has beyond what its correction can win. The rounding of positions is in it, and they may be
/// larger than the displacements of a step.
constexpr long bits_beside = 10;
/// Right bits of the solution in double.
constexpr long bits_of_start = 48;

}  // namespace

template <Scalar S>
Newton<S>::Level::Level(const Problem<S>& full_problem, const Hbvm<S>& full_method)
    : problem(full_problem),
      method(full_method),
      equations(problem, method),
      x(equations.make_unknowns()),
      r{x.gamma, x.lambda},
      q0(problem.m()),
      p0(problem.m()) {}

template <Scalar S>
Newton<S>::Newton(const Problem<S>& problem, const Hbvm<S>& method, [[maybe_unused]] Start start)
    : problem_(problem),
      method_(method),
      change_(problem.m()),
      position_scale_(problem),
      positions_(problem.m()),
      rule_(problem.m(), roundings_of_a_sweep(problem, method), static_cast<int>(bits_per_sweep)) {
  if constexpr (std::same_as<S, double>) {
    rounded_.emplace(problem, method);
    return;
  }
  equations_.emplace(problem_, method_);
  x_ = equations_->make_unknowns();
  if (!fits_double(problem)) return;
  rounded_problem_.emplace(in_double(problem));
  rounded_method_.emplace(in_double(method));
  rounded_.emplace(*rounded_problem_, *rounded_method_, SimplifiedNewton<double>::Wanted::start);
  if (start == Start::fixed_point)
    swept_.emplace(*rounded_problem_, *rounded_method_, FixedPoint<double>::Order::newest);
  rounded_q0_.resize(problem.m());
  rounded_p0_.resize(problem.m());
  r_ = {x_.gamma, x_.lambda};
  correction_ = {rounded_->unknowns().gamma, rounded_->unknowns().lambda};
  momentum_ = correction_.momentum;
  momentum_change_.emplace(*rounded_method_);
  last_change_.resize(problem.m());
  update_count_.per_call.add(Op::add, x_.gamma.size() + x_.lambda.size());
  make_rungs();
}

template <Scalar S>
void Newton<S>::make_rungs() {
  if constexpr (std::same_as<S, Mpfr>) {
    // Limbs of 64 bits decide the cost: from two on, a sixteenth more from rung to rung.
    constexpr long limb = 64;
    for (long limbs = 2; limb * limbs < bits_; limbs = std::max(limbs + 1, limbs * 17 / 16)) {
      // The digits whose bits fit in the limbs, with what Boost adds and what the products need beside.
      const auto digits = static_cast<unsigned>(static_cast<double>(limb * limbs - 4 - AlignedMatrix::guard_bits) *
                                                std::numbers::ln2 / std::numbers::ln10);
      const PrecisionScope scope(digits);
      rungs_.push_back({digits, mpfr_working_bits(), std::make_unique<Level>(problem_, method_)});
    }
  }
}

template <Scalar S>
void Newton<S>::take_step(const S& h) {
  set(h_, h);
  set(rate_, S(1));
  failed_in_double_ = !rounded_ || !fits_double(h_);
  sweeps_ = true;
}

template <Scalar S>
long Newton<S>::start_in_double() {
  const StepStart<double> start{rounded_q0_, rounded_p0_, approximately(h_)};
  long sweeps = 0;
  if (swept_ && sweeps_) {
    try {
      sweeps = swept_->solve(start);
      sweeps_ = sweeps <= FixedPoint<double>::slow;
      rounded_->adopt(start, swept_->unknowns());
      return sweeps;
    } catch (const StageFailure& failure) {
      sweeps = failure.sweeps();
      sweeps_ = false;
    }
  }
  return sweeps + rounded_->solve(start);
}

template <Scalar S>
long Newton<S>::solve(const StepStart<S>& start) {
  if constexpr (std::same_as<S, double>) {
    const long sweeps = rounded_->solve(start);
    x_ = rounded_->unknowns();
    change_ = rounded_->change();
    return sweeps;
  } else {
    if (start.h != h_) take_step(start.h);
    long sweeps = 0;
    if (!failed_in_double_) {
      for (Index j = 0; j < rounded_q0_.size(); ++j) {
        rounded_q0_[j] = approximately(start.q[j]);
        rounded_p0_[j] = approximately(start.p[j]);
      }
      try {
        sweeps = start_in_double();
        const auto [corrections, fell] = refine(start);
        sweeps += corrections;
        if (fell) return sweeps;
        failed_in_double_ = corrections > 0;
      } catch (const StageFailure& failure) {
        sweeps += failure.sweeps();
      }
    }
    return sweeps + solve_in_full(start);
  }
}

template <Scalar S>
long Newton<S>::solve_in_full(const StepStart<S>& start) {
  if (!full_) full_ = std::make_unique<SimplifiedNewton<S>>(problem_, method_);
  const long sweeps = full_->solve(start);
  set(x_, full_->unknowns());
  change_ = full_->change();
  return sweeps;
}

template <Scalar S>
void Newton<S>::take_residual(const StageResidual<S>& r, long& exponent) {
  const PartCall counted(rounding_count_);
  // Rows come to the size of velocities, as the Jacobian's are, so that no unit and no heavy body drowns a light one.
  const Jacobian<double>& jacobian = rounded_->jacobian();
  exponent = exponent_of_zero;
  const auto raise = [&](const Matrix<S>& rows, Index column, long row_exponent) {
    for (Index i = 0; i < rows.rows(); ++i)
      exponent = std::max(exponent, binary_exponent(rows(i, column)) - row_exponent);
  };
  const auto take = [&](const Matrix<S>& rows, Index column, long row_exponent, Matrix<double>& to) {
    for (Index i = 0; i < rows.rows(); ++i) to(i, column) = scaled(rows(i, column), exponent + row_exponent);
  };
  for (Index j = 0; j < r.momentum.cols(); ++j) raise(r.momentum, j, jacobian.coordinate_exponent(j));
  for (Index a = 0; a < r.constraint.cols(); ++a) raise(r.constraint, a, jacobian.constraint_exponent(a));
  for (Index j = 0; j < r.momentum.cols(); ++j)
    take(r.momentum, j, jacobian.coordinate_exponent(j), correction_.momentum);
  for (Index a = 0; a < r.constraint.cols(); ++a)
    take(r.constraint, a, jacobian.constraint_exponent(a), correction_.constraint);
  for (Index j = 0; j < momentum_.cols(); ++j)
    for (Index i = 0; i < momentum_.rows(); ++i)
      momentum_(i, j) = std::ldexp(correction_.momentum(i, j), static_cast<int>(jacobian.coordinate_exponent(j)));
}

template <Scalar S>
typename Newton<S>::Evaluated Newton<S>::evaluate(long bits) {
  for (Rung& rung : rungs_) {
    if (rung.bits < bits) continue;
    const PrecisionScope scope(rung.digits);
    Level& level = *rung.level;
    set(level.q0, equations_->q0());
    set(level.p0, equations_->p0());
    set(level.h, equations_->step());
    level.equations.start({level.q0, level.p0, level.h});
    set(level.x.gamma, x_.gamma);
    set(level.x.lambda, x_.lambda);
    level.equations.residual(level.x, level.r);
    return {level.equations, level.r};
  }
  equations_->residual(x_, r_);
  return {*equations_, r_};
}

template <Scalar S>
std::pair<long, bool> Newton<S>::refine(const StepStart<S>& from) {
  using Verdict = typename StoppingRule<S>::Verdict;
  equations_->start(from);
  const StageUnknowns<double>& start = rounded_->unknowns();
  for (Index i = 0; i < x_.gamma.size(); ++i) set_scaled(x_.gamma.data()[i], start.gamma.data()[i], 0);
  for (Index i = 0; i < x_.lambda.size(); ++i) set_scaled(x_.lambda.data()[i], start.lambda.data()[i], 0);
  for (Index i = 0; i < x_.psi.size(); ++i) set_scaled(x_.psi.data()[i], start.psi.data()[i], 0);
  for (Index i = 0; i < x_.zeta.size(); ++i) set_scaled(x_.zeta.data()[i], start.zeta.data()[i], 0);
  const double h = rounded_->equations().step();
  position_scale_.evaluate(from.q, h_, positions_);
  rule_.start(from.p, positions_);
  rule_.expect_rate(rate_);
  rule_.show_terms(x_.psi, &h_);
  long left = -bits_of_start;
  int slow = 0;
  for (long sweeps = 1;; ++sweeps) {
    long exponent = 0;
    const Evaluated evaluated = evaluate(-left + bits_per_sweep + bits_beside);
    const bool full = &evaluated.residual == &r_;
    // Displacements of bodies far from the origin have few digits in double: those just evaluated have all.
    if (sweeps == 1 && !rounded_->refresh(evaluated.equations)) return {0, false};
    take_residual(evaluated.residual, exponent);
    rounded_->jacobian().solve_scaled(correction_);
    const PartCall counted(update_count_);
    for (Index j = 0; j < x_.gamma.cols(); ++j) {
      double largest = 0;
      for (Index i = 0; i < method_.s; ++i) {
        raise_magnitude(largest, correction_.momentum(i, j));
        set_scaled(t_, -correction_.momentum(i, j), exponent);
        set_sum(x_.gamma(i, j), x_.gamma(i, j), t_);
      }
      set_scaled(t_, largest, exponent);
      rule_.show_change(j, t_);
    }
    for (Index i = 0; i < x_.lambda.size(); ++i) {
      set_scaled(t_, -correction_.constraint.data()[i] / h, exponent);
      set_sum(x_.lambda.data()[i], x_.lambda.data()[i], t_);
    }
    if (rule_.is_coarse()) rule_.show_terms(x_.gamma);
    const Verdict verdict = rule_.judge();
    if (verdict == Verdict::not_finite || verdict == Verdict::stagnant || verdict == Verdict::endless)
      return {sweeps, false};
    if (verdict == Verdict::converged) {
      if (full) {
        if (sweeps > 1) set(rate_, rule_.rate());
        equations_->changes(x_, change_);
        last_change_.setZero();
        momentum_change_->add(momentum_, correction_.momentum, last_change_);
        for (Index j = 0; j < last_change_.size(); ++j) {
          set_scaled(t_, last_change_[j], exponent);
          set_sum(change_.p_rest[j], change_.p_rest[j], t_);
        }
        return {sweeps, true};
      }
      left = -bits_;
      continue;
    }
    // In fewer digits than the coordinate nearest to its solution has already, the residual would spoil it.
    left = std::min(left, std::max(rule_.least_left(), -bits_));
    set_scaled(t_, 1, -least_bits);
    slow = rule_.shows_rate() && exceeds(rule_.rate(), t_) ? slow + 1 : 0;
    if (slow >= 3) return {sweeps, false};
  }
}

template <Scalar S>
SolverCounts Newton<S>::counts() const {
  if constexpr (std::same_as<S, double>) {
    return rounded_->counts();
  } else {
    SolverCounts sum;
    const auto add = [&](const StageEquations<S>& equations) {
      add_counts(sum, {equations.effect_counts(), equations.part_counts()}, problem_);
    };
    add(*equations_);
    for (const Rung& rung : rungs_) add(rung.level->equations);
    if (full_) add_counts(sum, full_->counts(), problem_);
    if (!rounded_) return sum;
    sum.parts.insert(sum.parts.end(), {rounding_count_, update_count_});
    const auto add_parts = [&](const std::vector<PartCount>& in_double) {
      sum.parts.insert(sum.parts.end(), in_double.begin(), in_double.end());
    };
    if (swept_) add_parts(swept_->counts_in_double());
    add_parts(rounded_->counts_in_double());
    return sum;
  }
}

template <Scalar S>
void Newton<S>::remember(Archive& archive) {
  bool full = full_ != nullptr;
  archive(h_, rate_, failed_in_double_, full, sweeps_);
  if (rounded_) archive(*rounded_);
  if (swept_) swept_->remember(archive);
  if (full && !full_) full_ = std::make_unique<SimplifiedNewton<S>>(problem_, method_);
  if (full) archive(*full_);
}

#define HBVM_DEFINE(S) template class Newton<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
