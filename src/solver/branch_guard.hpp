#pragma once

#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// Tells whether a solution of the stage equations may be the wrong one. There may be several, of which the one is
/// meant that comes to the start of the step when the step becomes short.
template <Scalar S>
class BranchGuard {
 public:
  BranchGuard(const Problem<S>& problem, const Hbvm<S>& method);

  /// The iteration's start, and the equations of the step. Both must live until the solution has been looked at.
  void start(const StageEquations<S>& equations, const StageUnknowns<S>& start);
  /// The size of a body is the greatest of |p0|, h |psi| and h |zeta| at the start. Whether the momenta of one differ
  /// from those of the start by more than its size, or h psi by more than half of it.
  bool is_far(const StageUnknowns<S>& x) const;
  /// Whether the force of a single constraint on some body differs from that at the start by more than four times the
  /// body's size. Where constraints are nearly dependent, branches lie side by side, and only multipliers tell that one
  /// was left.
  bool multipliers_run_wild(const StageUnknowns<S>& x) const;

 private:
  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  const StageEquations<S>* equations_ = nullptr;
  const StageUnknowns<S>* start_ = nullptr;
  Vector<S> size_;  ///< for each coordinate that of its body at the start
};

}  // namespace hbvm::core
