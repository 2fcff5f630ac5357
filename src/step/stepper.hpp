#pragma once

#include "solver/stage_solver.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// What a step leaves beside the state. It holds until the next step.
template <Scalar S>
struct StepResult {
  long sweeps = 0;                             ///< over the stage equations
  const Vector<S>* multiplier = nullptr;       ///< at the end of the step
  const StageUnknowns<S>* unknowns = nullptr;  ///< of the step's polynomials; null if the method has none
  bool reversed = false;  ///< the step is one back in time: the unknowns are of the step forward from (q, -p)
};

/// Makes one step after the other. What it learns from a step serves the next if that is of the same size. One that
/// wraps another (to choose its nodes, to divide a step that failed) is one, too.
template <Scalar S>
class Stepper {
 public:
  virtual ~Stepper() = default;

  virtual const Problem<S>& problem() const = 0;

  /// Advances the state by a step of size h.
  /// \return for a step made of parts the sweeps of all, and the multiplier and the unknowns of the last
  /// \throws StageFailure; the state is then as it was
  virtual StepResult<S> step(State<S>& state, const S& h) = 0;

  /// What was done since construction, and before it in a run that goes on. Times are measured while a MeasuredParts
  /// lives.
  virtual SolverCounts counts() const = 0;

  /// All that the next steps and counts() depend on to the last bit, beside problem, method and state.
  virtual void remember(Archive& archive) = 0;
};

/// One whose steps are its own. A method's stepper derives from it: it says step(), problem(), and the two below.
template <Scalar S>
class CountingStepper : public Stepper<S> {
 public:
  SolverCounts counts() const final { return sum_of(own_counts(), earlier_, this->problem()); }

  void remember(Archive& archive) final {
    SolverCounts sum = counts();
    remember_own(archive);
    archive(sum);
    if (archive.reading()) earlier_ = std::move(sum);
  }

 protected:
  /// What was done since construction.
  virtual SolverCounts own_counts() const = 0;
  /// All that the next steps depend on.
  virtual void remember_own(Archive& archive) = 0;

 private:
  SolverCounts earlier_;  ///< those of a run that this one continues
};

/// One whose steps are those of another. A class derived from it says what it does beside.
template <Scalar S>
class ForwardingStepper : public Stepper<S> {
 public:
  /// The other must outlive it.
  explicit ForwardingStepper(Stepper<S>& inner) : inner_(&inner) {}
  explicit ForwardingStepper(std::unique_ptr<Stepper<S>> inner) : kept_(std::move(inner)), inner_(kept_.get()) {}

  const Problem<S>& problem() const final { return inner_->problem(); }
  SolverCounts counts() const override { return inner_->counts(); }
  void remember(Archive& archive) override { archive(*inner_); }

 protected:
  Stepper<S>& inner() { return *inner_; }

 private:
  std::unique_ptr<Stepper<S>> kept_;
  Stepper<S>* inner_;
};

}  // namespace hbvm::core
