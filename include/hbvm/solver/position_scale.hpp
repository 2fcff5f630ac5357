#pragma once

#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// What rounding of the positions amounts to in the momenta of a step, over epsilon: h M^-1 gamma is added to positions
/// rounded to epsilon |q|, which a change of gamma by epsilon |M| |q| / h would do as well. Positions in space count by
/// the largest of them, since forces depend on their differences; directors by the largest of theirs.
template <Scalar S>
class PositionScale {
 public:
  PositionScale(const Problem<S>& problem, const S& step);

  /// scale_j for the positions q.
  void evaluate(const Vector<S>& q, Vector<S>& scale);

 private:
  std::vector<bool> turns_;        ///< coordinate j belongs to a director
  Vector<S> of_space_, of_turns_;  ///< sum_l |M_jl| / h over the coordinates of either kind
  S space_ = 0, directors_ = 0, t_ = 0;
};

#define HBVM_DECLARE(S) extern template class PositionScale<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
