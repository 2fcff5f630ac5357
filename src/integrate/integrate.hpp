#pragma once

#include <vector>

#include "integrate/checkpoint.hpp"
#include "integrate/observer.hpp"
#include "integrate/step_error.hpp"
#include "integrate/time_grid.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

template <Scalar S>
struct Integration {
  Snapshot<S> end;
  long steps = 0, sweeps = 0;
  double cpu_seconds = 0;      ///< processor time of this thread in steps alone: observers and output excluded
  double elapsed_seconds = 0;  ///< the time that passed meanwhile
};

/// Steps through the grid from `state` and shows t_0, t_1, …, t_N to the observers, some steps at a time. `each_step`
/// sees a step as soon as it is made. With `checkpoints` the run is kept at the start, whenever that is due, when a
/// signal ends it, and at the end. One that resumes goes on where it was, with stepper and observers as they were, and
/// shows what comes after.
/// \throws StepError
/// \throws Interrupted if a signal asks for it: between two steps, or within one that is made of many parts; then what
///         was kept last stays, as a stepper remembers parts of a step that was not finished
template <Scalar S>
Integration<S> integrate(Stepper<S>& stepper, State<S>& state, const TimeGrid<S>& grid,
                         const std::vector<Observer<S>*>& observers, Checkpoints* checkpoints = nullptr,
                         StepObserver<S>* each_step = nullptr);

}  // namespace hbvm::core
