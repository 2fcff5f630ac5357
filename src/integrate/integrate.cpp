#include "hbvm/integrate/integrate.hpp"

#include <algorithm>
#include <optional>

#include "hbvm/clock.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {

StepError::StepError(long step, std::string time, const StageFailure& failure)
    : IntegrationError("step " + std::to_string(step) + " from t = " + time + ": " +
                       std::string(name_of(failure.cause())) + ": " + failure.what() + " after " +
                       std::to_string(failure.sweeps()) + " sweeps, last increment " + failure.increment() +
                       " of the unknowns; " + std::string(remedy_of(failure.cause()))),
      cause_(failure.cause()),
      step_(step),
      time_(std::move(time)),
      increment_(failure.increment()) {}

template <Scalar S>
Integration<S> integrate(Stepper<S>& stepper, State<S>& state, const TimeGrid<S>& grid,
                         const std::vector<Observer<S>*>& observers) {
  Integration<S> result;
  const Vector<S> lambda0 = Point<S>(stepper.problem()).multiplier(state.q, state.p);
  const auto show = [&](const Snapshot<S>& snapshot) {
    for (Observer<S>* const observer : observers) observer->observe(snapshot);
  };
  result.end = {0, S(0), state.q, state.p, lambda0};
  show(result.end);

  // Steps are made in blocks and observed between them, so that the clock is read once a block.
  constexpr long block = 64;
  std::vector<Snapshot<S>> snapshots(static_cast<std::size_t>(std::min(block, grid.steps())), result.end);
  std::optional<StepError> failure;
  for (long n = 0; n < grid.steps() && !failure;) {
    std::size_t made = 0;
    const double before = thread_seconds();
    try {
      for (; made < snapshots.size() && n < grid.steps(); ++made) {
        result.sweeps += stepper.step(state);
        Snapshot<S>& snapshot = snapshots[made];
        snapshot.n = ++n;
        snapshot.q = state.q;
        snapshot.p = state.p;
        snapshot.lambda = stepper.multiplier();
      }
    } catch (const StageFailure& error) {
      failure.emplace(n + 1, to_text(grid.time(n)), error);
    }
    result.cpu_seconds += thread_seconds() - before;
    for (std::size_t i = 0; i < made; ++i) {
      snapshots[i].t = grid.time(snapshots[i].n);
      show(snapshots[i]);
    }
    if (made > 0) result.end = snapshots[made - 1];
  }
  if (failure) throw StepError(*failure);
  result.steps = grid.steps();
  return result;
}

#define HBVM_DEFINE(S) \
  template Integration<S> integrate<S>(Stepper<S>&, State<S>&, const TimeGrid<S>&, const std::vector<Observer<S>*>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
