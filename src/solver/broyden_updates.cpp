#include "solver/broyden_updates.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
BroydenUpdates<S>::BroydenUpdates(const StageResidual<S>& like, bool used) {
  if (!used) return;
  kept_.assign(most, like);
  squares_.assign(most, S(0));
}

template <Scalar S>
S BroydenUpdates<S>::product(const StageResidual<S>& a, const StageResidual<S>& b, const Vector<S>& scale) {
  S sum = 0;
  for (Index j = 0; j < a.momentum.cols(); ++j) {
    if (scale[j] == 0) continue;
    set_zero(u_);
    for (Index i = 0; i < a.momentum.rows(); ++i) {
      set_quotient(t_, a.momentum(i, j), scale[j]);
      set_product(t_, t_, b.momentum(i, j));
      set_sum(u_, u_, t_);
    }
    set_quotient(u_, u_, scale[j]);
    set_sum(sum, sum, u_);
  }
  return sum;
}

template <Scalar S>
void BroydenUpdates<S>::update(StageResidual<S>& correction, const Vector<S>& scale) {
  const auto add = [&](const S& factor, const StageResidual<S>& other) {
    for (Index i = 0; i < correction.momentum.size(); ++i)
      add_product(correction.momentum.data()[i], factor, other.momentum.data()[i], t_);
    for (Index i = 0; i < correction.constraint.size(); ++i)
      add_product(correction.constraint.data()[i], factor, other.constraint.data()[i], t_);
  };
  for (std::size_t n = 0; n + 1 < known_; ++n) add(S(product(kept_[n], correction, scale) / squares_[n]), kept_[n + 1]);
  if (known_ == 0) return;
  // An update that turns it round, or makes it many times as long, is none.
  const S ratio = product(kept_[known_ - 1], correction, scale) / squares_[known_ - 1];
  if (!(4 * magnitude(ratio) <= 3)) return;
  const S factor = 1 / (1 - ratio);
  set_product(correction.momentum, factor, correction.momentum);
  set_product(correction.constraint, factor, correction.constraint);
}

template <Scalar S>
void BroydenUpdates<S>::keep(const StageResidual<S>& correction, const Vector<S>& scale, bool small) {
  if (small || known_ == kept_.size()) known_ = 0;
  if (small || kept_.empty()) return;
  StageResidual<S>& kept = kept_[known_];
  set(kept.momentum, correction.momentum);
  set(kept.constraint, correction.constraint);
  set(squares_[known_], product(kept, kept, scale));
  if (squares_[known_] > 0) ++known_;
}

#define HBVM_DEFINE(S) template class BroydenUpdates<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
