#pragma once

#include <memory>

#include "scalar/archive.hpp"
#include "solver/solver_counts.hpp"
#include "solver/solver_kind.hpp"
#include "solver/stage_equations.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

/// Solves the stage equations of one step after the other. What it learns from one step serves the next, unless that
/// is of another size.
template <Scalar S>
class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// \return the number of sweeps over the stage equations
  /// \throws StageFailure
  virtual long solve(const StepStart<S>& start) = 0;

  /// The solution: its gamma and lambda are converged; its psi and zeta are those of the last sweep.
  virtual const StageUnknowns<S>& unknowns() const = 0;
  virtual const StepChange<S>& change() const = 0;

  /// What was done since construction.
  virtual SolverCounts counts() const = 0;

  /// All that the next steps depend on to the last bit, beside problem, method, step and state; not the counts.
  virtual void remember(Archive& archive) = 0;
};

template <Scalar S>
std::unique_ptr<StageSolver<S>> make_solver(SolverKind kind, const Problem<S>& problem, const Hbvm<S>& method);

}  // namespace hbvm::core
