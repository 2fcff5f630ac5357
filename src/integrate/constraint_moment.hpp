#pragma once

#include "integrate/seen_quantity.hpp"
#include "problem/constraint_gradient.hpp"

namespace hbvm::core {

/// What some constraints do to the directors of a rigid body, as a moment about the body's reference point:
///
///     w . M = -sum_a lambda_a grad g_a . dq,   dq = (w x d_1, w x d_2, ..),
///
/// as the virtual work of turning the body about w says.
template <Scalar S>
class ConstraintMoment {
 public:
  /// The problem must outlive it.
  explicit ConstraintMoment(const Problem<S>& problem);
  ConstraintMoment(const ConstraintMoment&) = delete;
  ConstraintMoment& operator=(const ConstraintMoment&) = delete;

  /// \param constraints their numbers among all of the problem, redundant ones included
  /// \param directors the first coordinate of each
  /// \param w three components; in the plane one, across it
  S operator()(const SeenState<S>& state, const std::vector<Index>& constraints, const std::vector<Index>& directors,
               const Vector<S>& w);

 private:
  Problem<S> problem_;  // whose constraints are all
  ConstraintGradient<S> gradient_;
  Vector<S> turned_;
};

}  // namespace hbvm::core
