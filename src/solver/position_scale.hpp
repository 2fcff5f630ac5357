#pragma once

#include "problem/problem.hpp"

namespace hbvm::core {

/// What rounding of the positions amounts to in the momenta of a step, over epsilon. h M^-1 gamma is added to positions
/// rounded to epsilon |q|, and a change of gamma by epsilon |M| |q| / h would do the same. Positions in space count by
/// the largest of them, since forces depend on their differences; directors by the largest of theirs.
template <Scalar S>
class PositionScale {
 public:
  /// The problem must outlive it.
  explicit PositionScale(const Problem<S>& problem);

  /// scale_j for the positions q and a step of size h.
  void evaluate(const Vector<S>& q, const S& h, Vector<S>& scale);

 private:
  void take_step(const S& h);

  const Problem<S>& problem_;
  S h_ = 0;                        ///< of of_space_ and of_turns_
  std::vector<bool> turns_;        ///< coordinate j belongs to a director
  Vector<S> of_space_, of_turns_;  ///< sum_l |M_jl| / h over the coordinates of either kind
  S space_ = 0, directors_ = 0, t_ = 0;
};

}  // namespace hbvm::core
