#include "integrate/constraint_drift.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
ConstraintDrift<S>::ConstraintDrift(const Problem<S>& problem, const S& rounding)
    : problem_(problem),
      rounding_(rounding),
      start_(Vector<S>::Zero(problem.nu())),
      greatest_(Vector<S>::Zero(problem.nu())),
      w_(Vector<S>::Zero(problem.m())) {}

/// Of the change in greatest_[a].
template <Scalar S>
S ConstraintDrift<S>::drift(ConstraintGradient<S>& gradient, Index a, const Vector<S>& q) {
  const auto& own = gradient.pattern(a);
  Index column = own.first;
  set_zero(size_);
  for (const Index coordinate : own.coordinates) {
    set_product(t_, gradient.values()(0, column++), q[coordinate]);
    set_magnitude(t_, t_);
    set_sum(size_, size_, t_);
  }
  if (!(greatest_[a] > size_ * rounding_)) return 0;
  const auto& weighted = gradient.weighted_pattern(a);
  column = weighted.first;
  for (const Index coordinate : weighted.coordinates) set(w_[coordinate], gradient.weighted_values()(0, column++));
  gradient.transposed_times(a, lanes(std::as_const(w_)), &along_);
  const S bending = magnitude(curvature(problem_.constraints[static_cast<std::size_t>(a)], problem_.dimension, q, w_));
  for (const Index coordinate : weighted.coordinates) set_zero(w_[coordinate]);
  return along_ == 0 ? S(0) : S(greatest_[a] * bending / (along_ * along_));
}

template <Scalar S>
void ConstraintDrift<S>::observe(ConstraintGradient<S>& gradient, const Matrix<S>& g, const Snapshot<S>& snapshot) {
  for (Index a = 0; a < start_.size(); ++a) {
    if (snapshot.n == 0) {
      set(start_[a], g(0, a));
      continue;
    }
    set_difference(change_, g(0, a), start_[a]);
    if (!exceeds(change_, greatest_[a])) continue;
    set_magnitude(greatest_[a], change_);
    const S found = drift(gradient, a, snapshot.q);
    if (!(found > worst_.drift)) continue;
    worst_.drift = found;
    worst_.constraint = a;
    set(worst_.t, snapshot.t);
    if (worst_.lost || !(found * part > 1)) continue;
    worst_.lost = true;
    set(worst_.lost_t, snapshot.t);
  }
}

#define HBVM_DEFINE(S) template class ConstraintDrift<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
