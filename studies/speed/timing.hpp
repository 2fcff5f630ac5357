#pragma once

#include <algorithm>
#include <vector>

#include "clock.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"
#include "step/rattle.hpp"

namespace hbvm::core::speed {

/// The best of five runs, in seconds of processor time per call.
template <class F>
double best_of_five(long calls, F&& f) {
  double best = 0;
  for (int run = 0; run < 5; ++run) {
    const double before = thread_seconds();
    for (long i = 0; i < calls; ++i) f();
    const double time = (thread_seconds() - before) / static_cast<double>(calls);
    best = run == 0 ? time : std::min(best, time);
  }
  return best;
}

/// As many calls as take about a twentieth of a second.
template <class F>
long enough_calls(F&& f) {
  constexpr double target = 0.05;
  for (long calls = 1;; calls *= 4) {
    const double before = thread_seconds();
    for (long i = 0; i < calls; ++i) f();
    const double time = thread_seconds() - before;
    if (time > target / 4) return std::max(1L, static_cast<long>(static_cast<double>(calls) * target / time));
  }
}

/// Seconds of a call that is repeated as often as it takes to see it.
template <class F>
double seconds_of(F&& f) {
  const long calls = enough_calls(f);
  return best_of_five(calls, f);
}

struct StepCost {
  double seconds = 0, sweeps = 0;  ///< of a step
};

/// The cost of one step, after the first two, without observers: the best of five runs of so many steps, each with a
/// new stepper.
template <Scalar S, class Make>
StepCost cost_of_steps(const Assembled<S>& scene, const S& h, long steps, Make&& make) {
  StepCost best;
  for (int run = 0; run < 5; ++run) {
    auto stepper = make();
    State<S> state(scene.q0, scene.p0);
    for (int i = 0; i < 2; ++i) stepper.step(state, h);
    long sweeps = 0;
    const double before = thread_seconds();
    for (long i = 0; i < steps; ++i) sweeps += stepper.step(state, h).sweeps;
    const double time = (thread_seconds() - before) / static_cast<double>(steps);
    if (run == 0 || time < best.seconds) best = {time, static_cast<double>(sweeps) / static_cast<double>(steps)};
  }
  return best;
}

template <Scalar S>
StepCost step_cost(const Assembled<S>& scene, int k, int s, const S& h, SolverKind solver, long steps) {
  const Hbvm<S> method = make_hbvm<S>(k, s);
  return cost_of_steps<S>(scene, h, steps, [&] { return HbvmStepper<S>(scene.problem, method, solver); });
}

template <Scalar S>
StepCost rattle_cost(const Assembled<S>& scene, const S& h, long steps) {
  return cost_of_steps<S>(scene, h, steps, [&] { return Rattle<S>(scene.problem); });
}

}  // namespace hbvm::core::speed
