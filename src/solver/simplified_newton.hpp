#pragma once

#include "solver/branch_guard.hpp"
#include "solver/newton_iteration.hpp"
#include "solver/newton_starts.hpp"
#include "solver/solver_counts.hpp"
#include "solver/stage_solver.hpp"

namespace hbvm::core {

/// Solves the stage equations by NewtonIteration, with everything in the working precision. In double it is Newton's
/// solver itself, and the start and the Jacobian of the mixed-precision one. In more digits it serves where double
/// cannot hold the problem or its condition.
///
/// The iteration starts from what NewtonStarts has. That may lead nowhere, or to a solution of which BranchGuard says
/// that it may be the wrong one. Then the solution is taken that is found by following it from much shorter steps.
template <Scalar S>
class SimplifiedNewton {
 public:
  using Wanted = typename NewtonIteration<S>::Wanted;
  SimplifiedNewton(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted = Wanted::solution);

  /// \return the number of residuals
  /// \throws StageFailure
  long solve(const StepStart<S>& from);
  /// The solution that shorter and shorter steps lead to, found by following it from 2^-12 or 2^-30 of the step.
  /// \return the number of residuals
  /// \throws StageFailure
  long follow(const StepStart<S>& from);
  /// Takes this for the solution of the step: that of another solver.
  void adopt(const StepStart<S>& from, const StageUnknowns<S>& solution);
  /// What was done: by effect and by part of the equations, of the Jacobian and of the iteration.
  SolverCounts counts() const;
  /// The same in a step of more digits, the stage equations as one part.
  std::vector<PartCount> counts_in_double() const;

  /// Evaluates the Jacobian at the solution, with positions, velocities and gradients rounded from those of more
  /// digits. \return false if it is singular
  template <Scalar T>
  [[nodiscard]] bool refresh(const StageEquations<T>& at) {
    iteration_.equations().round(at);
    return iteration_.evaluate_jacobian();
  }

  const StageUnknowns<S>& unknowns() const { return iteration_.unknowns(); }
  Jacobian<S>& jacobian() { return iteration_.jacobian(); }
  const Jacobian<S>& jacobian() const { return iteration_.jacobian(); }
  const StageEquations<S>& equations() const { return iteration_.equations(); }
  const StepChange<S>& change() const { return iteration_.change(); }

  void remember(Archive& archive) { archive(h_, starts_, iteration_); }

 private:
  enum class Start { previous, constant, shorter, shortest };
  /// \return whether it leads to the solution that is meant; adds the residuals
  /// \throws StageFailure from the shortest
  bool leads_to_solution(Start start, const StepStart<S>& from, long& sweeps);

  NewtonIteration<S> iteration_;
  NewtonStarts<S> starts_;
  BranchGuard<S> guard_;
  S h_ = 0;  ///< of the last step
};

}  // namespace hbvm::core
