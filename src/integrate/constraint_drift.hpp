#pragma once

#include <vector>

#include "integrate/observer.hpp"
#include "problem/constraint_gradient.hpp"

namespace hbvm::core {

/// How far constraints have moved from their values at the start, each relative to its own size. The nearest state
/// where g_a is what it was lies along w = M^-1 grad g_a. There g_a is, but for terms of order 3, a polynomial of
/// degree 2,
///
///     g_a + x b + x^2/2 c,   b = grad g_a^T w,   c = (nabla^2 g_a)(w, w),
///
/// and the drift of g_a is measured by b^2/c, its only size that depends neither on units nor on where the origin is.
/// Of a rod it is twice the square of the length, so that the drift is the relative error of the length. What is linear
/// along w has no such size, and its drift counts as 0; methods keep it.
template <Scalar S>
class ConstraintDrift {
 public:
  static constexpr int part = 100;  ///< a constraint is lost when it drifts by more than 1/100

  /// The problem must outlive it. What rounding may have made of a run, relative to the terms of g, is no drift.
  ConstraintDrift(const Problem<S>& problem, const S& rounding);

  /// A mesh point, and g and the gradient there.
  void observe(ConstraintGradient<S>& gradient, const Matrix<S>& g, const Snapshot<S>& snapshot);
  void remember(Archive& archive) {
    archive(start_, greatest_, worst_.drift, worst_.constraint, worst_.t, worst_.lost, worst_.lost_t);
  }

  struct Worst {
    S drift = 0, t = 0;
    Index constraint = 0;
    bool lost = false;  ///< some constraint
    S lost_t = 0;       ///< the first time of that
  };
  const Worst& worst() const { return worst_; }

 private:
  S drift(ConstraintGradient<S>& gradient, Index a, const Vector<S>& q);

  const Problem<S>& problem_;
  S rounding_;
  Vector<S> start_, greatest_;  ///< of each g: its value at the start, and its greatest change
  Vector<S> w_;                 ///< 0 but where it is used
  Worst worst_;
  S change_, along_, size_, t_;
};

}  // namespace hbvm::core
