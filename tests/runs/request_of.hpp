#pragma once

#include <utility>
#include <vector>

#include "run/recording.hpp"
#include "run/run_request.hpp"
#include "run/simulate.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// A run as its texts ask for it.
inline RunRequest request_of(const Scene& scene, const std::string& method, const std::string& step,
                             const std::string& until, const std::string& precision = "double",
                             SolverKind solver = SolverKind::automatic) {
  return {scene,
          parse_method(method),
          solver,
          Expression::parse(step),
          Expression::parse(until),
          Precision::parse(precision)};
}

/// What a picture shows of a run of HBVM(2,2), and how the run ended.
template <Scalar S>
std::pair<Recording, Simulated<S>> recorded(const Scene& text, const std::string& step, const std::string& until) {
  const Assembled<S> scene = assemble<S>(text);
  const TimeGrid<S> grid(Expression::parse(step), Expression::parse(until));
  Recording recording;
  MotionRecorder<S> recorder(scene.problem, grid.steps(), recording);
  const std::vector<Observer<S>*> observers{&recorder};
  Simulated<S> run = simulate(scene, make_hbvm<S>(2, 2), SolverKind::automatic, grid, observers);
  return {std::move(recording), std::move(run)};
}

}  // namespace hbvm::core
