#pragma once

#include <optional>
#include <vector>

#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// A constraint whose gradient is a combination of those of others before it, so that (regular) does not hold.
struct Dependence {
  Index constraint;
  std::vector<Index> others;
};

/// The first such constraint at q, by Cholesky's method on the Gram matrix grad g^T M^-1 grad g in more than twice the
/// working digits: what is dependent but for the rounding of the coordinates counts as dependent.
template <Scalar S>
std::optional<Dependence> find_dependence(const Problem<S>& problem, const Vector<S>& q);

/// Ratio of the largest to the smallest eigenvalue of the Gram matrix at q, in double; 1 without constraints.
template <Scalar S>
double gram_condition(const Problem<S>& problem, const Vector<S>& q);

/// The same with every gradient normalised, in the metric M^-1: of the angles between them alone.
template <Scalar S>
double angle_condition(const Problem<S>& problem, const Vector<S>& q);

#define HBVM_DECLARE(S)                                                                              \
  extern template std::optional<Dependence> find_dependence<S>(const Problem<S>&, const Vector<S>&); \
  extern template double gram_condition<S>(const Problem<S>&, const Vector<S>&);                     \
  extern template double angle_condition<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
