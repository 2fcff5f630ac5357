#include "hbvm/solver/newton_in_double.hpp"

#include <Eigen/LU>
#include <cmath>

#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

/// Increments that fall by less a sweep are worth a new Jacobian.
constexpr double slow = 1 / double{10};

/// An increment that fell by more than this may have done so because the start was off where the old Jacobian is exact;
/// the next one need not.
constexpr double least_rate = 1 / double{4096};

/// Row 0 of X_s^-1.
Vector<double> first_row_of_inverse(const Matrix<double>& X) {
  const Vector<double> e = Vector<double>::Unit(X.rows(), 0);
  return X.transpose().partialPivLu().solve(e);
}

}  // namespace

NewtonInDouble::NewtonInDouble(const Problem<double>& problem, const Hbvm<double>& method, double step)
    : problem_(problem),
      method_(method),
      equations_(problem, method, step),
      jacobian_(problem, method, step),
      x_(equations_.make_unknowns()),
      residual_{x_.gamma, x_.lambda},
      momentum_(x_.gamma),
      first_row_of_inverse_X_(first_row_of_inverse(method.X_s)),
      momentum_change_(problem.m()),
      sequence_(x_.gamma.size() + x_.lambda.size()),
      extrapolation_(sequence_.size()) {
  const Index C = 4 * (method.k + 3 * method.s + problem.m() + method.s * problem.nu());
  tolerance_ = static_cast<double>(C) * epsilon<double>();
}

long NewtonInDouble::solve(const Vector<double>& q0, const Vector<double>& p0) {
  equations_.start(q0, p0);
  long sweeps = 0;
  const auto attempt = [&](Start start) {
    try {
      if (start == Start::shorter) {
        sweeps += grow(q0, p0);
        usable_ = false;
      } else {
        prepare(start, p0);
      }
      sweeps += iterate(equations_, jacobian_);
      return true;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      usable_ = false;
      if (start == Start::shorter) throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps);
      return false;
    }
  };
  if (extrapolation_.empty() || !attempt(Start::previous))
    if (!attempt(Start::constant)) attempt(Start::shorter);
  std::copy_n(x_.gamma.data(), x_.gamma.size(), sequence_.data());
  std::copy_n(x_.lambda.data(), x_.lambda.size(), sequence_.data() + x_.gamma.size());
  extrapolation_.add(sequence_.data());
  return sweeps;
}

void NewtonInDouble::prepare(Start start, const Vector<double>& p0) {
  if (start == Start::previous) {
    extrapolation_.predict(sequence_.data());
    std::copy_n(sequence_.data(), x_.gamma.size(), x_.gamma.data());
    std::copy_n(sequence_.data() + x_.gamma.size(), x_.lambda.size(), x_.lambda.data());
    return;
  }
  x_.gamma.setZero();
  x_.gamma.row(0) = p0.transpose();
  x_.lambda.setZero();
  // The multipliers of these positions, as a sweep of the fixed-point iteration has them.
  equations_.move(x_.gamma);
  equations_.forces(x_.psi);
  if (!equations_.multipliers(x_.psi, x_.lambda, x_.zeta)) x_.lambda.setZero();
}

long NewtonInDouble::grow(const Vector<double>& q0, const Vector<double>& p0) {
  constexpr int halvings = 5;
  long sweeps = 0;
  prepare(Start::constant, p0);
  for (int n = halvings; n > 0; --n) {
    const double h = std::ldexp(equations_.step(), -n);
    StageEquations<double> shorter(problem_, method_, h);
    Jacobian jacobian(problem_, method_, h);
    shorter.start(q0, p0);
    usable_ = false;
    sweeps += iterate(shorter, jacobian);
    // The degree j of v grows with the step to the power j.
    for (Index j = 1; j < method_.s; ++j) x_.gamma.row(j) *= std::ldexp(1, static_cast<int>(j));
  }
  return sweeps;
}

long NewtonInDouble::iterate(StageEquations<double>& equations, Jacobian& jacobian) {
  const double h = equations.step();
  double last = 0;
  int growing = 0;
  bool slowing = !usable_;
  for (long sweeps = 1; sweeps <= max_sweeps; ++sweeps) {
    equations.residual(x_, residual_);
    if (slowing) {
      if (!jacobian.factor(equations, x_.lambda))
        throw StageFailure(FailureCause::near_singular_constraints, "the Jacobian of the stage equations is singular",
                           to_scientific(last, 3), sweeps);
      usable_ = true;
    }
    momentum_ = residual_.momentum;
    const double hidden = max_norm(residual_.constraint);
    jacobian.solve(residual_);
    x_.gamma -= residual_.momentum;
    x_.lambda -= residual_.constraint / h;
    const double size = std::max(
        {equations.p0().cwiseAbs().maxCoeff(), max_norm(x_.gamma), h * max_norm(x_.zeta), h * max_norm(x_.psi)});
    double increment = max_norm(residual_.momentum);
    raise_to(increment, max_norm(residual_.constraint));
    if (increment != 0) increment /= size;
    if (!std::isfinite(increment))
      throw StageFailure(FailureCause::stage_equations_diverge, "an iterate is not finite", to_scientific(increment, 3),
                         sweeps);
    // Nothing is known of it before the second sweep: a Jacobian kept from earlier steps may have become worse.
    const double rate = sweeps > 1 && last > 0 ? increment / last : 1;
    const double rate_to_come = std::max(rate, least_rate);
    // What is left after this sweep is about rate/(1 - rate) increments.
    // A residual as large as what it is the residual of shows no solution, however small the increments.
    const bool small = max_norm(momentum_) <= std::sqrt(epsilon<double>()) * size;
    const double left = 2 * rate < 1 ? increment * rate_to_come : increment;
    const bool converged = small && left <= epsilon<double>() / 8;
    // Or the increments are round-off, also where it is magnified by an ill-conditioned Jacobian: then the residual is.
    const bool round_off = max_norm(momentum_) <= tolerance_ * size &&
                           hidden <= tolerance_ * max_norm(equations.constraint_gradient().values()) *
                                         max_norm(equations.node_velocities());
    if (converged || (small && sweeps > 1 && 2 * rate >= 1 && (increment <= tolerance_ || round_off))) {
      for (Index j = 0; j < momentum_change_.size(); ++j) momentum_change_[j] = h * (x_.psi(0, j) - x_.zeta(0, j));
      add_change_of_momentum(momentum_, residual_.momentum, momentum_change_);
      return sweeps;
    }
    growing = sweeps > 1 && increment > last ? growing + 1 : 0;
    if (growing >= 8)
      throw StageFailure(FailureCause::stage_equations_diverge, "the increments grow", to_scientific(increment, 3),
                         sweeps);
    slowing = sweeps > 1 && rate > slow;
    last = increment;
  }
  throw StageFailure(FailureCause::stage_equations_diverge, "the increments stagnate", to_scientific(last, 3),
                     max_sweeps);
}

bool NewtonInDouble::refresh() {
  usable_ = jacobian_.factor(equations_, x_.lambda);
  return usable_;
}

void NewtonInDouble::add_change_of_momentum(const Matrix<double>& momentum, const Matrix<double>& correction,
                                            Vector<double>& change) const {
  for (Index j = 0; j < change.size(); ++j)
    for (Index i = 0; i < method_.s; ++i) change[j] += first_row_of_inverse_X_[i] * (momentum(i, j) - correction(i, j));
}

}  // namespace hbvm
