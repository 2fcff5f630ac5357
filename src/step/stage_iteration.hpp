#pragma once

#include "linear/arrays.hpp"
#include "linear/product.hpp"
#include "scalar/text.hpp"
#include "solver/extrapolation.hpp"
#include "solver/stopping_rule.hpp"
#include "step/add_compensated.hpp"
#include "step/state.hpp"

namespace hbvm::core {

// What methods share whose stages have momenta P_i, velocities V_i and forces F_i, s x m each.

/// x = base + h x in every lane.
template <Scalar S>
void scale_and_shift(Matrix<S>& x, const S& h, const Vector<S>& base) {
  for (Index j = 0; j < x.cols(); ++j)
    for (Index i = 0; i < x.rows(); ++i) {
      set_product(x(i, j), h, x(i, j));
      set_sum(x(i, j), base[j], x(i, j));
    }
}

/// Sweeps until the rule sees that P is found. A sweep makes P anew from what was P, which is P_before then, with
/// forces F on the way. \return their number \throws StageFailure
template <Scalar S, class Sweep>
long iterate_stages(StoppingRule<S>& rule, const Vector<S>& p0, const Vector<S>& positions, const S& h,
                    const Matrix<S>& P, const Matrix<S>& P_before, const Matrix<S>& F, Sweep&& sweep) {
  using Ruling = typename StoppingRule<S>::Verdict;
  rule.start(p0, positions);
  for (;;) {
    sweep();
    rule.show_change(P, P_before);
    if (rule.is_coarse()) {
      rule.show_terms(P);
      rule.show_terms(F, &h);
    }
    const Ruling verdict = rule.judge();
    if (verdict == Ruling::converged) return rule.sweeps();
    if (verdict != Ruling::go_on) throw rule.failure(verdict);
  }
}

/// Finds P and the multipliers lambda by `iterate`, from the extrapolation of the last steps. If that leads nowhere it
/// starts once more, from P = p_0 and lambda = 0. They stand in `sequence` then, P first.
/// \return sweeps \throws StageFailure
template <Scalar S, class Iterate>
long find_stages(Extrapolation<S>& extrapolation, Vector<S>& sequence, const Vector<S>& p0, Matrix<S>& P,
                 Matrix<S>& lambda, Iterate&& iterate) {
  const auto for_each = [&](auto f) {
    for (Index i = 0; i < P.size(); ++i) f(P.data()[i], sequence[i]);
    for (Index i = 0; i < lambda.size(); ++i) f(lambda.data()[i], sequence[P.size() + i]);
  };
  long sweeps = 0;
  if (!extrapolation.empty()) {
    try {
      extrapolation.predict(sequence.data());
      for_each([](S& unknown, const S& predicted) { set(unknown, predicted); });
      sweeps = iterate();
    } catch (const StageFailure& failure) {
      sweeps = failure.sweeps();
      extrapolation.clear();
    }
  }
  if (extrapolation.empty()) {
    set_zero(lambda);
    for (Index j = 0; j < P.cols(); ++j)
      for (Index i = 0; i < P.rows(); ++i) set(P(i, j), p0[j]);
    sweeps += iterate();
  }
  for_each([](const S& unknown, S& kept) { set(kept, unknown); });
  return sweeps;
}

/// The sums over stages that a step ends with, q_1 = q_0 + h b^T V and p_1 = p_0 + h b^T F, compensated. Owns its
/// storage.
template <Scalar S>
class StageSums {
 public:
  StageSums(const Vector<S>& b, Index m)
      : b_(b.transpose()), position_change_(Matrix<S>::Zero(1, m)), momentum_change_(position_change_) {}

  /// \throws StageFailure if anything is not finite; the state is then as it was
  void add_to(State<S>& state, const S& h, const Matrix<S>& V, const Matrix<S>& F, long sweeps) {
    product(position_change_, b_, V);
    product(momentum_change_, b_, F);
    for (Matrix<S>* change : {&position_change_, &momentum_change_}) {
      set_product(*change, h, *change);
      set_max_norm(size_, *change);
      if (!is_finite(size_))
        throw StageFailure(FailureCause::stage_equations_diverge, "a stage is not finite", to_scientific(size_, 3),
                           sweeps);
    }
    for (Index j = 0; j < state.q.size(); ++j) {
      add_compensated(state.q[j], state.q_carry[j], position_change_(0, j), s_, t_);
      add_compensated(state.p[j], state.p_carry[j], momentum_change_(0, j), s_, t_);
    }
  }

 private:
  Matrix<S> b_;                                  // 1 x s
  Matrix<S> position_change_, momentum_change_;  // 1 x m
  S size_ = 0, s_ = 0, t_ = 0;                   // kept: creating them allocates
};

}  // namespace hbvm::core
