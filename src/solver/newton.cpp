#include "hbvm/solver/newton.hpp"

#include <cmath>
#include <numbers>

#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

/// log2 |x| to less than a unit; of 0, less than that of any number.
constexpr long exponent_of_zero = -(1L << 40);
template <Scalar S>
long binary_exponent(const S& x) {
  if (x == 0) return exponent_of_zero;
  if constexpr (std::same_as<S, Mpfr>) {
    return mpfr_get_exp(raw(x));
  } else {
    int exponent = 0;
    using std::frexp;
    frexp(x, &exponent);
    return exponent;
  }
}

/// x 2^-exponent.
template <Scalar S>
double scaled(const S& x, long exponent) {
  if constexpr (std::same_as<S, Mpfr>) {
    long own = 0;
    const double fraction = mpfr_get_d_2exp(&own, raw(x), MPFR_RNDN);
    return own - exponent < -1000 ? 0 : std::ldexp(fraction, static_cast<int>(own - exponent));
  } else {
    using std::ldexp;
    return static_cast<double>(ldexp(x, static_cast<int>(-exponent)));
  }
}

/// x += y 2^exponent.
template <Scalar S>
void add_scaled(S& x, double y, long exponent, S& t) {
  if constexpr (std::same_as<S, Mpfr>) {
    mpfr_set_d(raw(t), y, MPFR_RNDN);
    mpfr_mul_2si(raw(t), raw(t), exponent, MPFR_RNDN);
    mpfr_add(raw(x), raw(x), raw(t), MPFR_RNDN);
  } else {
    using std::ldexp;
    x += ldexp(S(y), static_cast<int>(exponent));
  }
}

template <Scalar S>
void set_exactly(S& x, double y) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_set_d(raw(x), y, MPFR_RNDN);
  else
    x = S(y);
}

template <Scalar S>
long largest_exponent(const Matrix<S>& a) {
  long exponent = exponent_of_zero;
  for (Index i = 0; i < a.size(); ++i) exponent = std::max(exponent, binary_exponent(a.data()[i]));
  return exponent;
}

/// Bits that one sweep with a Jacobian in double can win.
constexpr long bits_per_sweep = 50;

/// Corrections that fall by less than a bit a sweep have stopped falling.
constexpr double least_rate = -1;

}  // namespace

template <Scalar S>
Newton<S>::Level::Level(const Problem<S>& full_problem, const Hbvm<S>& full_method, const S& step)
    : problem(full_problem),
      method(full_method),
      equations(problem, method, step),
      x(equations.make_unknowns()),
      r{x.gamma, x.lambda},
      q0(problem.m()),
      p0(problem.m()) {}

template <Scalar S>
Newton<S>::Newton(const Problem<S>& problem, const Hbvm<S>& method, const S& step)
    : problem_(problem), method_(method), h_(step), position_change_(problem.m()), momentum_change_(problem.m()) {
  if constexpr (std::same_as<S, double>) {
    rounded_.emplace(problem, method, step);
    return;
  }
  rounded_problem_.emplace(in_double(problem));
  rounded_method_.emplace(make_hbvm<double>(method.k, method.s));
  rounded_.emplace(*rounded_problem_, *rounded_method_, approximately(step));
  rounded_q0_.resize(problem.m());
  rounded_p0_.resize(problem.m());
  equations_.emplace(problem_, method_, h_);
  x_ = equations_->make_unknowns();
  r_ = {x_.gamma, x_.lambda};
  correction_ = {rounded_->unknowns().gamma, rounded_->unknowns().lambda};
  momentum_ = correction_.momentum;
  change_.resize(problem.m());
  tolerance_bits_ =
      std::log2(static_cast<double>(4 * (method.k + 3 * method.s + problem.m() + method.s * problem.nu())));
  make_rungs();
}

template <Scalar S>
void Newton<S>::make_rungs() {
  if constexpr (std::same_as<S, Mpfr>) {
    // Limbs of 64 bits decide the cost: from two on, a sixteenth more from rung to rung.
    constexpr long limb = 64;
    for (long limbs = 2; limb * limbs < bits_; limbs = std::max(limbs + 1, limbs * 17 / 16)) {
      // The digits whose bits, with what Boost adds, fit in the limbs.
      const auto digits =
          static_cast<unsigned>(static_cast<double>(limb * limbs - 4) * std::numbers::ln2 / std::numbers::ln10);
      const PrecisionScope scope(digits);
      rungs_.push_back({digits, mpfr_working_bits(), std::make_unique<Level>(problem_, method_, S(h_))});
    }
  }
}

template <Scalar S>
long Newton<S>::solve(const Vector<S>& q0, const Vector<S>& p0) {
  if constexpr (std::same_as<S, double>) {
    const long sweeps = rounded_->solve(q0, p0);
    x_ = rounded_->unknowns();
    rounded_->equations().changes(x_, position_change_, momentum_change_);
    momentum_change_ = rounded_->momentum_change();
    return sweeps;
  } else {
    for (Index j = 0; j < q0.size(); ++j) {
      rounded_q0_[j] = approximately(q0[j]);
      rounded_p0_[j] = approximately(p0[j]);
    }
    const long sweeps = rounded_->solve(rounded_q0_, rounded_p0_);
    if (!rounded_->refresh())
      throw StageFailure(FailureCause::near_singular_constraints,
                         "the Jacobian of the stage equations is singular at the solution in double", "0", sweeps);
    return sweeps + refine(q0, p0);
  }
}

template <Scalar S>
void Newton<S>::take_residual(const StageResidual<S>& r, long& exponent) {
  exponent = std::max(largest_exponent(r.momentum), largest_exponent(r.constraint));
  for (Index i = 0; i < r.momentum.size(); ++i) correction_.momentum.data()[i] = scaled(r.momentum.data()[i], exponent);
  for (Index i = 0; i < r.constraint.size(); ++i)
    correction_.constraint.data()[i] = scaled(r.constraint.data()[i], exponent);
  momentum_ = correction_.momentum;
}

template <Scalar S>
bool Newton<S>::residual(long bits, long& exponent) {
  for (Rung& rung : rungs_) {
    if (rung.bits < bits) continue;
    const PrecisionScope scope(rung.digits);
    Level& level = *rung.level;
    for (Index j = 0; j < level.q0.size(); ++j) {
      set(level.q0[j], equations_->q0()[j]);
      set(level.p0[j], equations_->p0()[j]);
    }
    level.equations.start(level.q0, level.p0);
    for (Index i = 0; i < x_.gamma.size(); ++i) set(level.x.gamma.data()[i], x_.gamma.data()[i]);
    for (Index i = 0; i < x_.lambda.size(); ++i) set(level.x.lambda.data()[i], x_.lambda.data()[i]);
    level.equations.residual(level.x, level.r);
    take_residual(level.r, exponent);
    return false;
  }
  equations_->residual(x_, r_);
  take_residual(r_, exponent);
  return true;
}

template <Scalar S>
long Newton<S>::refine(const Vector<S>& q0, const Vector<S>& p0) {
  equations_->start(q0, p0);
  const StageUnknowns<double>& start = rounded_->unknowns();
  for (Index i = 0; i < x_.gamma.size(); ++i) set_exactly(x_.gamma.data()[i], start.gamma.data()[i]);
  for (Index i = 0; i < x_.lambda.size(); ++i) set_exactly(x_.lambda.data()[i], start.lambda.data()[i]);
  const double h = rounded_->equations().step();
  const double size =
      std::max({max_norm(rounded_p0_), max_norm(start.gamma), h * max_norm(start.psi), h * max_norm(start.zeta)});
  // Unknowns that double cannot hold are zero there.
  const double size_bits = size > 0 ? std::log2(size) : static_cast<double>(binary_exponent(max_norm(p0)));
  // log2 of corrections over the size, and of the error left.
  double last = 0, left = -bits_per_sweep;
  int waiting = 0;
  for (long sweeps = 1;; ++sweeps) {
    long exponent = 0;
    const bool full = residual(static_cast<long>(-left) + bits_per_sweep + 2, exponent);
    rounded_->jacobian().solve(correction_);
    double norm = max_norm(correction_.momentum);
    raise_to(norm, max_norm(correction_.constraint));
    if (!std::isfinite(norm))
      throw StageFailure(FailureCause::stage_equations_diverge, "an iterate is not finite", "nan", sweeps);
    for (Index i = 0; i < x_.gamma.size(); ++i)
      add_scaled(x_.gamma.data()[i], -correction_.momentum.data()[i], exponent, t_);
    for (Index i = 0; i < x_.lambda.size(); ++i)
      add_scaled(x_.lambda.data()[i], -correction_.constraint.data()[i] / h, exponent, t_);
    const double now =
        norm > 0 ? std::log2(norm) + static_cast<double>(exponent) - size_bits : static_cast<double>(exponent_of_zero);
    const double rate = sweeps == 1 ? rate_ : std::max<double>(now - last, -bits_per_sweep);
    left = now + std::min(rate, least_rate);
    const double round_off = static_cast<double>(-bits_);
    const bool converged = rate < least_rate && now + rate <= round_off - 1;
    const bool stagnant = sweeps > 1 && rate >= least_rate && now <= round_off + tolerance_bits_;
    if (full && (converged || stagnant)) {
      if (sweeps > 1 && rate < least_rate) rate_ = rate;
      equations_->changes(x_, position_change_, momentum_change_);
      change_.setZero();
      rounded_->add_change_of_momentum(momentum_, correction_.momentum, change_);
      for (Index j = 0; j < change_.size(); ++j) add_scaled(momentum_change_[j], change_[j], exponent, t_);
      return sweeps;
    }
    if (converged || stagnant) left = round_off;
    waiting = rate >= least_rate ? waiting + 1 : 0;
    if (waiting >= 4 || sweeps > bits_)
      throw StageFailure(FailureCause::stage_equations_diverge, "the corrections do not fall",
                         to_scientific(std::exp2(now), 3), sweeps);
    last = now;
  }
}

template <Scalar S>
SolverCounts Newton<S>::counts() const {
  SolverCounts sum;
  const auto add = [&](const auto& equations) {
    add_counts(sum, {equations.effect_counts(), equations.part_counts()}, problem_);
  };
  if (equations_) add(*equations_);
  for (const Rung& rung : rungs_) add(rung.level->equations);
  add(rounded_->equations());
  const Jacobian& jacobian = rounded_->jacobian();
  sum.parts.push_back({"factors of the Jacobian", jacobian.factorisations(), jacobian.factor_operations()});
  sum.parts.push_back({"corrections", jacobian.solutions(), jacobian.solve_operations()});
  return sum;
}

template <Scalar S>
void Newton<S>::measure_time() {
  if (equations_) equations_->measure_time();
  for (Rung& rung : rungs_) rung.level->equations.measure_time();
  rounded_->equations().measure_time();
}

#define HBVM_DEFINE(S) template class Newton<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
