#include "integrate/integrate.hpp"

#include <algorithm>
#include <optional>

#include "clock.hpp"
#include "interruption.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
Integration<S> integrate(Stepper<S>& stepper, State<S>& state, const TimeGrid<S>& grid,
                         const std::vector<Observer<S>*>& observers, Checkpoints* checkpoints,
                         StepObserver<S>* each_step) {
  Integration<S> result;
  const auto show = [&](const Snapshot<S>& snapshot) {
    for (Observer<S>* const observer : observers) observer->observe(snapshot);
  };
  result.end = {0, S(0), state.q, state.p, StateEvaluator<S>(stepper.problem()).multiplier(state.q, state.p)};
  const auto contents = [&](Archive& archive) {
    archive(result.end.n, result.sweeps, result.cpu_seconds, result.elapsed_seconds, result.end.lambda, state, stepper);
    for (Observer<S>* const observer : observers) observer->remember(archive);
    if (each_step) each_step->remember(archive);
  };
  if (checkpoints && checkpoints->resumes()) {
    checkpoints->load(contents);
    result.end = {result.end.n, grid.time(result.end.n), state.q, state.p, result.end.lambda};
  } else {
    show(result.end);
  }
  // Also one that resumes shows at once whether it can be kept.
  if (checkpoints) checkpoints->save(contents);

  // Steps are made in blocks and observed between them, so that the clock is read once a block. Blocks of slow steps
  // are shorter, so that what was computed is soon seen and kept.
  constexpr std::size_t longest = 64;
  constexpr double long_enough = double{1} / 4;  // seconds a block
  std::vector<Snapshot<S>> snapshots(static_cast<std::size_t>(std::min<long>(longest, grid.steps())), result.end);
  std::size_t block = 1;
  std::optional<StepError> failure;
  bool within_step = false;
  for (long n = result.end.n; n < grid.steps() && !failure;) {
    std::size_t made = 0;
    const double before = thread_seconds(), elapsed_before = elapsed_seconds();
    try {
      for (; made < block && n < grid.steps() && !stop_asked(); ++made) {
        const StepResult<S> step = stepper.step(state, n + 1 == grid.steps() ? grid.last_step() : grid.step());
        result.sweeps += step.sweeps;
        if (each_step) each_step->observe(step, state);
        Snapshot<S>& snapshot = snapshots[made];
        snapshot.n = ++n;
        snapshot.q = state.q;
        snapshot.p = state.p;
        snapshot.lambda = *step.multiplier;
      }
    } catch (const StageFailure& error) {
      failure.emplace(n + 1, to_text(grid.time(n)), error);
    } catch (const Interrupted&) {
      within_step = true;
    }
    const double seconds = thread_seconds() - before;
    result.cpu_seconds += seconds;
    result.elapsed_seconds += elapsed_seconds() - elapsed_before;
    for (std::size_t i = 0; i < made; ++i) {
      snapshots[i].t = grid.time(snapshots[i].n);
      show(snapshots[i]);
    }
    if (made > 0) result.end = snapshots[made - 1];
    block = seconds > long_enough ? std::max<std::size_t>(block / 2, 1) : std::min(2 * block, snapshots.size());

    const bool asked = n < grid.steps() && stop_asked();
    if (checkpoints && !failure && !within_step && (asked || n == grid.steps() || checkpoints->due()))
      checkpoints->save(contents);
    if (asked && !failure) {
      const int signal = stop_request->number();
      throw Interrupted(signal, (signal != 0 ? "interrupted by " + name_of_signal(signal) : "stopped") +
                                    " after step " + std::to_string(n) + ", t = " + to_text(result.end.t));
    }
  }
  if (failure) throw StepError(*failure);
  result.steps = grid.steps();
  return result;
}

#define HBVM_DEFINE(S)                                                                                               \
  template Integration<S> integrate<S>(Stepper<S>&, State<S>&, const TimeGrid<S>&, const std::vector<Observer<S>*>&, \
                                       Checkpoints*, StepObserver<S>*);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
