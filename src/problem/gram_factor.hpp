#pragma once

#include "linear/lu.hpp"
#include "linear/ordering.hpp"
#include "problem/constraint_gradient.hpp"

namespace hbvm::core {

/// From this number of constraints on, the Gram matrix grad g^T M^-1 grad g is factored by its band.
constexpr Index many_constraints = 128;

/// The factors of the Gram matrix of many constraints at the q of a gradient in one lane. Constraints that share no
/// body leave zeros there. In the order that gathers the others beside the diagonal, it takes O(nu b^2) operations for
/// a half bandwidth b.
template <Scalar S>
class GramFactor {
 public:
  /// \return false if it is singular to working precision
  [[nodiscard]] bool factor(ConstraintGradient<S>& gradient, Index nu);
  /// x = (grad g^T M^-1 grad g)^-1 x.
  void solve(Vector<S>& x);

 private:
  Ordering order_;
  Lu<S> lu_;
  Vector<S> ordered_;
};

}  // namespace hbvm::core
