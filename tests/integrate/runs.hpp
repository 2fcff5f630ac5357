#pragma once

#include <algorithm>
#include <vector>

#include "integrate/integrate.hpp"
#include "integrate/observations.hpp"
#include "scene/assemble.hpp"
#include "scene/observe.hpp"
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

/// The values of these observations at the start of a scene, in the working precision.
inline Vector<Mpfr> seen_at_start(Scene scene, const std::vector<std::string>& observations) {
  for (const std::string& observation : observations) scene = with_observation(scene, observation, observation);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  Observations<Mpfr> seen(scene, start.problem);
  return seen.see(Mpfr(0), start.q0, start.p0);
}

}  // namespace hbvm::core
