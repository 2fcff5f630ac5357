#pragma once

#include <algorithm>
#include <vector>

#include "integrate/integrate.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

/// Keeps all it sees.
template <Scalar S>
struct Recorder final : Observer<S> {
  std::vector<Snapshot<S>> seen;
  void observe(const Snapshot<S>& snapshot) override { seen.push_back(snapshot); }
};

/// A scene with all it takes to integrate it once.
template <Scalar S>
struct SceneRun {
  Assembled<S> scene;
  Hbvm<S> method;
  TimeGrid<S> grid;
  HbvmStepper<S> stepper;
  State<S> state;

  /// r nodes for the constraints, s if it is less.
  SceneRun(const Scene& text, int k, int s, const char* step, const char* until,
           SolverKind kind = SolverKind::fixed_point, int r = 0)
      : scene(assemble<S>(text)),
        method(make_hbvm<S>(k, s, std::max(r, s))),
        grid(Expression::parse(step), Expression::parse(until)),
        stepper(scene.problem, method, kind),
        state(scene.q0, scene.p0) {}
  SceneRun(const SceneRun&) = delete;

  StepResult<S> step() { return stepper.step(state, grid.step()); }
  Integration<S> operator()(const std::vector<Observer<S>*>& observers, StepObserver<S>* each_step = nullptr) {
    return integrate<S>(stepper, state, grid, observers, nullptr, each_step);
  }
};

}  // namespace hbvm::core
