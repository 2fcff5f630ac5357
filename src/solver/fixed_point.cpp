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
}

template <Scalar S>
long FixedPoint<S>::solve(const Vector<S>& q0, const Vector<S>& p0) {
  equations_.start(q0, p0);
  position_scale_ = max_norm(equations_.problem().mass.momentum(q0)) / equations_.step();
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
long FixedPoint<S>::iterate() {
  const S h = equations_.step(), eps = epsilon<S>();
  const bool papers = order_ == Order::paper;
  S least = 0, increment = 0, last = 0, size = 0, term;
  long waiting = 0;
  for (long sweeps = 1;; ++sweeps) {
    if (!sweep())
      throw StageFailure("the linear system (lam) for the multipliers is singular", to_scientific(increment, 3),
                         sweeps);
    set_zero(increment);
    for (Index i = 0; i < x_.gamma.size(); ++i) {
      set_difference(term, x_.gamma.data()[i], gamma_before_.data()[i]);
      raise_to(increment, magnitude(term));
    }
    if (papers) {
      for (Index i = 0; i < x_.psi.size(); ++i) {
        set_difference(term, x_.psi.data()[i], psi_before_.data()[i]);
        set_product(term, term, h);
        raise_to(increment, magnitude(term));
      }
    }
    // Once the increments are small, the scale changes no more.
    if (!(16 * increment <= size)) {
      set(size, max_norm(equations_.p0()));
      raise_to(size, max_norm(x_.gamma));
      raise_to(size, S(h * std::max(max_norm(x_.psi), max_norm(x_.zeta))));
    }
    // Left to change, if the next increments fall by as much as this one did. In the paper's order they fall unevenly.
    const bool falls = !papers && sweeps > 1 && 2 * increment < last;
    const S left = falls ? S(increment * (increment / last)) : increment;
    // In the paper's order psi lags by a sweep, so that a small first increment would not mean convergence.
    if (left <= size * eps / 4 && sweeps > 1) return sweeps;
    last = increment;
    if (increment != 0) increment /= std::max(size, position_scale_);
    if (!is_finite(increment)) throw StageFailure("an iterate is not finite", to_scientific(increment, 3), sweeps);
    if (sweeps == 1 || increment < least) {
      least = increment;
      waiting = 0;
      continue;
    }
    ++waiting;
    if (increment <= tolerance_ && waiting >= 2) return sweeps;
    if (waiting >= patience)
      throw StageFailure(increment > 10 * least ? "the increments grow" : "the increments stagnate",
                         to_scientific(increment, 3), sweeps);
  }
}

#define HBVM_DEFINE(S) template class FixedPoint<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
