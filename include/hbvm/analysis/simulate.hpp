#pragma once

#include <optional>

#include "hbvm/integrate/drift.hpp"
#include "hbvm/scene/assemble.hpp"

namespace hbvm {

/// A run in one precision: what ends it and its drifts.
template <Scalar S>
struct Simulated {
  Integration<S> integration;
  S H0, e_H, e_g, e_hid;
};

/// Integrates an assembled scene with its drift observed, beside further observers.
/// \throws StepError, IntegrationError
template <Scalar S>
Simulated<S> simulate(const Assembled<S>& scene, const Hbvm<S>& method, SolverKind solver, const TimeGrid<S>& grid,
                      std::vector<Observer<S>*> observers = {}) {
  Drift<S> drift(scene.problem);
  observers.insert(observers.begin(), &drift);
  Stepper<S> stepper(scene.problem, method, grid.step(), solver);
  State<S> state(scene.q0, scene.p0);
  Integration<S> integration = integrate(stepper, state, grid, observers);
  return {std::move(integration), drift.H0(), drift.e_H(), drift.e_g(), drift.e_hid()};
}

}  // namespace hbvm
