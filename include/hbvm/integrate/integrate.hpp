#pragma once

#include <string>
#include <vector>

#include "hbvm/integrate/checkpoint.hpp"
#include "hbvm/integrate/time_grid.hpp"
#include "hbvm/step/stepper.hpp"

namespace hbvm {

/// The solution at one mesh point. `lambda` is (lagmul) of the step that ends there; at n = 0 that of the exact state,
/// (Theorem lamex).
template <Scalar S>
struct Snapshot {
  long n = 0;
  S t;
  Vector<S> q, p, lambda;
};

/// Looks at every mesh point, in order. What it throws ends the integration.
template <Scalar S>
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const Snapshot<S>& snapshot) = 0;
  /// All that it gathered, for a run that goes on from a checkpoint.
  virtual void remember(Archive&) { throw InputError("--checkpoint: something that looks at this run cannot be kept"); }
};

/// A step that could not be made. What was computed before it has been shown to the observers.
class StepError : public IntegrationError {
 public:
  StepError(long step, std::string time, const StageFailure& failure);
  FailureCause cause() const { return cause_; }
  long step() const { return step_; }
  const std::string& time() const { return time_; }
  const std::string& increment() const { return increment_; }

 private:
  FailureCause cause_;
  long step_;
  std::string time_, increment_;
};

template <Scalar S>
struct Integration {
  Snapshot<S> end;
  long steps = 0, sweeps = 0;
  double cpu_seconds = 0;  ///< processor time of this thread in steps alone: observers and output excluded
};

/// Steps through the grid from `state` and shows t_0, t_1, …, t_N to the observers. With `checkpoints` the run is kept
/// at the start, whenever that is due, when a signal ends it, and at the end; one that resumes goes on where it was,
/// with stepper and observers as they were, and shows what comes after.
/// \throws StepError
/// \throws Interrupted between two steps, if a signal asks for it
template <Scalar S>
Integration<S> integrate(Stepper<S>& stepper, State<S>& state, const TimeGrid<S>& grid,
                         const std::vector<Observer<S>*>& observers, Checkpoints* checkpoints = nullptr);

#define HBVM_DECLARE(S)                                                                   \
  extern template Integration<S> integrate<S>(Stepper<S>&, State<S>&, const TimeGrid<S>&, \
                                              const std::vector<Observer<S>*>&, Checkpoints*);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
