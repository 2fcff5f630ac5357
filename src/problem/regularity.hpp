#pragma once

#include <optional>
#include <vector>

#include "problem/problem.hpp"

namespace hbvm::core {

/// A constraint whose gradient at some q is sum_b x_b grad g_b over others, so that (3) does not hold.
template <Scalar S>
struct Dependence {
  Index constraint;
  std::vector<Index> others;  ///< none if the gradient vanishes
  /// nabla^2 g (v, v) - sum_b x_b nabla^2 g_b (v, v), and a bound of its round-off. It is the second derivative of g
  /// along a motion with velocity v that fulfils the others.
  S bending, round_off;
};

template <Scalar S>
struct Independence {
  std::vector<Index> kept;  ///< ascending
  std::vector<Dependence<S>> redundant;
  /// The constraint that is nearest to a combination of others before it, among those kept. This is the square of the
  /// sine of the angle between them in the metric M^-1, 1 if there is none.
  S square_of_sine = 1;
  Index nearest = -1;
  std::vector<Index> near;
};

/// The constraints that are independent at q. Cholesky's method judges it on the Gram matrix grad g^T M^-1 grad g in
/// more than twice the working digits. What is dependent but for the rounding of the coordinates counts as dependent.
/// Among dependent constraints those are kept that stand best apart from one another.
/// \param rounding the relative one of the coordinates
template <Scalar S>
Independence<S> find_independent(const Problem<S>& problem, const Vector<S>& q, const Vector<S>& v,
                                 const S& rounding = epsilon<S>());

/// Moves the redundant constraints of a problem without any aside.
template <Scalar S>
void set_aside(Problem<S>& problem, const Independence<S>& independence);

/// Ratio of the largest to the smallest eigenvalue of the Gram matrix at q, in double; 1 without constraints.
template <Scalar S>
double gram_condition(const Problem<S>& problem, const Vector<S>& q);

/// The condition of the Gram matrix with every gradient normalised in the metric M^-1. It depends on the angles between
/// gradients alone.
template <Scalar S>
double angle_condition(const Problem<S>& problem, const Vector<S>& q);

}  // namespace hbvm::core
