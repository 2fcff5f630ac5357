#pragma once

#include "solver/stage_solver.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// Makes one step after the other. What it learns from a step serves the next if that is of the same size. One that
/// wraps another (to choose its nodes, to divide a step that failed) is one, too.
template <Scalar S>
class Stepper {
 public:
  virtual ~Stepper() = default;

  virtual const Problem<S>& problem() const = 0;

  /// Advances the state by a step of size h.
  /// \return sweeps over the stage equations
  /// \throws StageFailure; the state is then as it was
  virtual long step(State<S>& state, const S& h) = 0;

  /// The multiplier at the end of the last step.
  virtual const Vector<S>& multiplier() const = 0;

  /// The solution of the stage equations of the last step (of its last part, if it was divided); null if the method has
  /// none.
  virtual const StageUnknowns<S>* unknowns() const { return nullptr; }

  /// What was done since construction.
  virtual SolverCounts counts() const = 0;
  /// Also measure the time that effects and parts of the equations take.
  virtual void measure_time() = 0;

  /// All that the next steps and counts() depend on to the last bit, beside problem, method and state.
  virtual void remember(Archive& archive) = 0;

 protected:
  /// Remembers counts(), which become the `earlier` ones of a run that goes on.
  void remember_counts(Archive& archive, SolverCounts& earlier) const {
    SolverCounts sum = counts();
    archive(sum);
    if (archive.reading()) earlier = std::move(sum);
  }
};

}  // namespace hbvm::core
