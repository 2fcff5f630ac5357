#include "hbvm/solver/fixed_point.hpp"

#include <algorithm>

#include "hbvm/linear/product.hpp"
#include "hbvm/scalar/in_place.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {

template <Scalar S>
FixedPoint<S>::FixedPoint(const Problem<S>& problem, const Hbvm<S>& method, const S& step, Order order)
    : equations_(problem, method, step),
      order_(order),
      x_(equations_.make_unknowns()),
      gamma_before_(x_.gamma),
      psi_before_(x_.psi),
      extrapolation_(x_.gamma.size()),
      position_change_(problem.m()),
      momentum_change_(problem.m()) {
  const Index C = 4 * (method.k + 3 * method.s + problem.m() + method.s * problem.nu());
  tolerance_ = S(static_cast<long>(C)) * epsilon<S>();
  quarter_epsilon_ = epsilon<S>() / 4;
}

template <Scalar S>
long FixedPoint<S>::solve(const Vector<S>& q0, const Vector<S>& p0) {
  equations_.start(q0, p0);
  equations_.problem().mass.momentum(q0, momentum_change_);
  set_max_norm(position_scale_, momentum_change_);
  set_quotient(position_scale_, position_scale_, equations_.step());
  long sweeps = 0;
  if (order_ == Order::paper) {
    prepare(Start::zero, p0);
    sweeps = iterate();
  } else {
    if (!extrapolation_.empty()) {
      try {
        extrapolation_.predict(x_.gamma.data());
        sweeps = iterate();
      } catch (const StageFailure& failure) {
        sweeps = failure.sweeps();
        extrapolation_.clear();
      }
    }
    if (extrapolation_.empty()) {
      prepare(Start::constant, p0);
      sweeps += iterate();
    }
    extrapolation_.add(x_.gamma.data());
  }
  equations_.changes(x_, position_change_, momentum_change_);
  return sweeps;
}

template <Scalar S>
void FixedPoint<S>::prepare(Start start, const Vector<S>& p0) {
  for (Matrix<S>* unknown : {&x_.gamma, &x_.psi, &x_.zeta, &x_.lambda})
    for (Index i = 0; i < unknown->size(); ++i) set_zero(unknown->data()[i]);
  if (start == Start::constant)
    for (Index j = 0; j < x_.gamma.cols(); ++j) set(x_.gamma(0, j), p0[j]);
}

template <Scalar S>
bool FixedPoint<S>::sweep() {
  std::swap(gamma_before_, x_.gamma);
  std::swap(psi_before_, x_.psi);
  equations_.move(gamma_before_);
  equations_.forces(x_.psi);
  const Matrix<S>& psi = order_ == Order::paper ? psi_before_ : x_.psi;
  if (!equations_.multipliers(psi, x_.lambda, x_.zeta)) return false;
  equations_.momenta(psi, x_.zeta, x_.gamma);
  return true;
}

template <Scalar S>
void FixedPoint<S>::measure_increment() {
  set_zero(increment_);
  for (Index i = 0; i < x_.gamma.size(); ++i) {
    set_difference(term_, x_.gamma.data()[i], gamma_before_.data()[i]);
    raise_magnitude(increment_, term_);
  }
  if (order_ == Order::paper) {
    for (Index i = 0; i < x_.psi.size(); ++i) {
      set_difference(term_, x_.psi.data()[i], psi_before_.data()[i]);
      set_product(term_, term_, equations_.step());
      raise_magnitude(increment_, term_);
    }
  }
}

template <Scalar S>
void FixedPoint<S>::measure_size() {
  set_max_norm(size_, equations_.p0());
  set_max_norm(term_, x_.gamma);
  raise_magnitude(size_, term_);
  for (const Matrix<S>* force : {&x_.psi, &x_.zeta}) {
    set_max_norm(term_, *force);
    set_product(term_, term_, equations_.step());
    raise_magnitude(size_, term_);
  }
}

template <Scalar S>
long FixedPoint<S>::iterate() {
  const bool papers = order_ == Order::paper;
  set_zero(size_);
  long waiting = 0;
  for (long sweeps = 1;; ++sweeps) {
    if (!sweep())
      throw StageFailure(FailureCause::near_singular_constraints,
                         "the linear system (lam) for the multipliers is singular",
                         to_scientific(sweeps > 1 ? scaled_ : S(0), 3), sweeps);
    measure_increment();
    // Once the increments are small, the scale changes no more.
    set_product(term_, increment_, sixteen_);
    if (sweeps == 1 || !(term_ <= size_)) measure_size();
    // Left to change, if the next increments fall by as much as this one did. In the paper's order they fall unevenly.
    set_sum(left_, increment_, increment_);
    if (!papers && sweeps > 1 && left_ < last_) {
      set_quotient(left_, increment_, last_);
      set_product(left_, left_, increment_);
    } else {
      set(left_, increment_);
    }
    // In the paper's order psi lags by a sweep, so that a small first increment would not mean convergence.
    set_product(term_, size_, quarter_epsilon_);
    if (left_ <= term_ && sweeps > 1) return sweeps;
    set(last_, increment_);
    set(scaled_, increment_);
    if (increment_ != 0) set_quotient(scaled_, increment_, size_ > position_scale_ ? size_ : position_scale_);
    if (!is_finite(scaled_))
      throw StageFailure(FailureCause::stage_equations_diverge, "an iterate is not finite", to_scientific(scaled_, 3),
                         sweeps);
    if (sweeps == 1 || scaled_ < least_) {
      set(least_, scaled_);
      waiting = 0;
      continue;
    }
    ++waiting;
    if (scaled_ <= tolerance_ && waiting >= 2) return sweeps;
    if (waiting >= patience)
      throw StageFailure(FailureCause::stage_equations_diverge,
                         scaled_ > 10 * least_ ? "the increments grow" : "the increments stagnate",
                         to_scientific(scaled_, 3), sweeps);
  }
}

#define HBVM_DEFINE(S) template class FixedPoint<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
