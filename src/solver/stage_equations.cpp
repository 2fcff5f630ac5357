#include "hbvm/solver/stage_equations.hpp"

#include "hbvm/linear/product.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
StageEquations<S>::StageEquations(const Problem<S>& problem, const Hbvm<S>& method, const S& step)
    : problem_(problem), method_(method), h_(step), potential_(problem.potential, method.k),
      gradient_(problem, method.s) {
  const Index s = method.s, m = problem.m(), n = s * problem.nu();
  velocity_.resize(s, m);
  h_velocity_.resize(s, m);
  u_.resize(s, m);
  w_.resize(s, m);
  rhs_momentum_.resize(s, m);
  system_.matrix().resize(n, n);
  rhs_.resize(n);
}

template <Scalar S>
StageUnknowns<S> StageEquations<S>::make_unknowns() const {
  const Index s = method_.s, m = problem_.m();
  const Matrix<S> zero = Matrix<S>::Zero(s, m);
  return {zero, zero, zero, Matrix<S>::Zero(s, problem_.nu())};
}

template <Scalar S>
void StageEquations<S>::start(const Vector<S>& q0, const Vector<S>& p0) {
  q0_ = &q0;
  p0_ = &p0;
}

template <Scalar S>
void StageEquations<S>::move(const Matrix<S>& gamma) {
  problem_.mass.velocity(lanes(gamma), lanes(velocity_));
  for (Index i = 0; i < velocity_.size(); ++i) set_product(h_velocity_.data()[i], h_, velocity_.data()[i]);
}

template <Scalar S>
void StageEquations<S>::positions(const Matrix<S>& integrals, Matrix<S>& u) {
  product(u, integrals, h_velocity_);
  for (Index j = 0; j < u.cols(); ++j)
    for (Index i = 0; i < u.rows(); ++i) set_sum(u(i, j), u(i, j), (*q0_)[j]);
}

template <Scalar S>
void StageEquations<S>::forces(Matrix<S>& psi) {
  if (potential_.has_varying_force()) {
    positions(method_.I_hat, u_hat_);
    potential_.varying_force(lanes(u_hat_), force_);
    product(psi, method_.projection_hat, force_);
  } else {
    for (Index i = 0; i < psi.size(); ++i) set_zero(psi.data()[i]);
  }
  // A constant force has the one coefficient psi_0 = force.
  const Vector<S>& constant = potential_.constant_force();
  for (Index j = 0; j < psi.cols(); ++j) set_sum(psi(0, j), psi(0, j), constant[j]);
}

template <Scalar S>
bool StageEquations<S>::multipliers(const Matrix<S>& psi, Matrix<S>& lambda, Matrix<S>& zeta) {
  const Index nu = problem_.nu(), s = method_.s;
  if (nu == 0) return true;
  positions(method_.I_s, u_);
  gradient_.update(lanes(u_));

  // (lam) divided by h: sum_j a_ij grad g_i^T M^-1 grad g_j lambda_j = grad g_i^T M^-1 (p0/h + sum_j I_ij psi_j)
  Matrix<S>& a = system_.matrix();
  for (Index i = 0; i < a.size(); ++i) set_zero(a.data()[i]);
  for (const auto& pair : gradient_.couplings()) {
    for (Index j = 0; j < s; ++j) {
      for (Index i = 0; i < s; ++i) {
        S& entry = a(i * nu + pair.a, j * nu + pair.b);
        gradient_.coupling(pair, i, j, entry);
        set_product(entry, entry, method_.A(i, j));
      }
    }
  }
  product(rhs_momentum_, method_.I_s, psi);
  for (Index j = 0; j < rhs_momentum_.cols(); ++j) {
    set_quotient(t_, (*p0_)[j], h_);
    for (Index i = 0; i < s; ++i) set_sum(rhs_momentum_(i, j), rhs_momentum_(i, j), t_);
  }
  problem_.mass.velocity(lanes(rhs_momentum_), lanes(w_));
  for (Index i = 0; i < s; ++i)
    for (Index b = 0; b < nu; ++b) gradient_.transposed_times(i, b, lanes(w_), rhs_[i * nu + b]);
  if (!system_.factor()) return false;
  system_.solve(rhs_);
  for (Index i = 0; i < s; ++i)
    for (Index b = 0; b < nu; ++b) set(lambda(i, b), rhs_[i * nu + b]);

  for (Index i = 0; i < w_.size(); ++i) set_zero(w_.data()[i]);
  gradient_.add_times(lambda, lanes(w_));
  product(zeta, method_.projection, w_);
  return true;
}

template <Scalar S>
void StageEquations<S>::momenta(const Matrix<S>& psi, const Matrix<S>& zeta, Matrix<S>& gamma) {
  const Index s = method_.s;
  const Matrix<S>& X = method_.X_s;
  for (Index i = 0; i < w_.size(); ++i) set_difference(w_.data()[i], psi.data()[i], zeta.data()[i]);
  for (Index j = 0; j < gamma.cols(); ++j) {
    for (Index i = 0; i < s; ++i) {
      S& sum = gamma(i, j);
      if (i == 0)
        set_product(sum, X(0, 0), w_(0, j));
      else
        set_product(sum, X(i, i - 1), w_(i - 1, j));
      if (i + 1 < s) add_product(sum, X(i, i + 1), w_(i + 1, j), t_);
      set_product(sum, sum, h_);
    }
    set_sum(gamma(0, j), gamma(0, j), (*p0_)[j]);
  }
}

#define HBVM_DEFINE(S) template class StageEquations<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
