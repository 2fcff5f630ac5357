#pragma once

#include <optional>

#include "integrate/coefficient_decay.hpp"
#include "integrate/drift.hpp"
#include "integrate/integrate.hpp"
#include "run/account.hpp"
#include "scene/assemble.hpp"
#include "step/backward_stepper.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

/// A run in one precision: what ends it and its drifts.
template <Scalar S>
struct Simulated {
  Integration<S> integration;
  S H0, e_H, e_B, e_g, e_hid;
  S redundancy;    ///< of Drift
  State<S> state;  ///< what was propagated, with its carry
};

/// Where a run begins, if not at the start of its scene, and where it is kept.
template <Scalar S>
struct Course {
  std::optional<State<S>> start = {};
  Checkpoints* checkpoints = nullptr;
};

/// Integrates an assembled scene by a stepper with its drift observed, beside further observers. With `account`, the
/// time of effects and parts of the solver is measured, too; with `decay`, it sees every step.
/// \throws StepError, IntegrationError; Interrupted as integrate() does
template <Scalar S>
Simulated<S> simulate(const Assembled<S>& scene, Stepper<S>& stepper, const TimeGrid<S>& grid,
                      std::vector<Observer<S>*> observers = {}, Account* account = nullptr,
                      CoefficientDecay<S>* decay = nullptr, const Course<S>& course = {}) {
  Drift<S> drift(scene.problem);
  observers.insert(observers.begin(), &drift);
  std::optional<MeasuredParts> measured;
  if (account) measured.emplace();
  State<S> state = course.start ? *course.start : State<S>(scene.q0, scene.p0);
  BackwardStepper<S> backward(stepper);
  Stepper<S>& used = grid.direction() == Direction::backward ? static_cast<Stepper<S>&>(backward) : stepper;
  Integration<S> integration = integrate<S>(used, state, grid, observers, course.checkpoints, decay);
  if (account) {
    *account = account_of(scene.problem, stepper.counts());
    balance(*account, integration.cpu_seconds, integration.elapsed_seconds);
    account->steps = static_cast<std::uint64_t>(integration.steps);
    account->sweeps = static_cast<std::uint64_t>(integration.sweeps);
  }
  return {std::move(integration), drift.H0(),         drift.e_H(),     drift.e_B(), drift.e_g(),
          drift.e_hid(),          drift.redundancy(), std::move(state)};
}

/// The same by steps of one method.
template <Scalar S>
Simulated<S> simulate(const Assembled<S>& scene, const Hbvm<S>& method, SolverKind solver, const TimeGrid<S>& grid,
                      std::vector<Observer<S>*> observers = {}, Account* account = nullptr) {
  HbvmStepper<S> stepper(scene.problem, method, solver);
  return simulate<S>(scene, stepper, grid, std::move(observers), account);
}

}  // namespace hbvm::core
