#include "hbvm/analysis/run.hpp"

#include <ostream>

#include "hbvm/analysis/simulate.hpp"
#include "hbvm/integrate/output_state.hpp"
#include "hbvm/integrate/trajectory.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/scalar/with_scalar.hpp"

namespace hbvm {
namespace {

template <Scalar S>
class Progress final : public Observer<S> {
 public:
  Progress(const std::function<void(long, long)>& report, long steps) : report_(report), steps_(steps) {}
  void observe(const Snapshot<S>& snapshot) override {
    if (report_) report_(snapshot.n, steps_);
  }

 private:
  const std::function<void(long, long)>& report_;
  long steps_;
};

template <Scalar S>
std::vector<std::string> texts(const Vector<S>& v) {
  std::vector<std::string> result;
  for (Index i = 0; i < v.size(); ++i) result.push_back(to_text(v[i]));
  return result;
}

template <Scalar S>
RunResult run_in(const RunRequest& request, const RunHooks& hooks) {
  const TimeGrid<S> grid(request.step, request.until, request.scene.constants);
  const Assembled<S> scene = assemble<S>(request.scene);
  const Hbvm<S> method = make_hbvm<S>(request.method.k, request.method.s);

  Progress<S> progress(hooks.progress, grid.steps());
  std::vector<Observer<S>*> observers{&progress};
  std::unique_ptr<std::ostream> csv = hooks.open_csv ? hooks.open_csv() : nullptr;
  std::optional<Trajectory<S>> trajectory;
  if (csv) {
    trajectory.emplace(scene.problem, *csv, hooks.every, grid.steps(), hooks.provenance);
    observers.push_back(&*trajectory);
  }
  const Simulated<S> simulated = simulate(scene, method, request.solver, grid, observers);

  const Snapshot<S>& end = simulated.integration.end;
  RunResult result;
  result.step = to_text(grid.step());
  result.t = to_text(end.t);
  result.steps = grid.steps();
  result.q = texts(end.q);
  result.p = texts(end.p);
  result.lambda = texts(end.lambda);
  Point<S> point(scene.problem);
  const OutputState<S> output = output_state(point, end.q, end.p);
  result.output_p = texts(output.p);
  result.output_lambda = texts(output.lambda);
  result.output_delta_H = to_text(S(point.energy(end.q, output.p) - simulated.H0));
  result.e_H = to_text(simulated.e_H);
  result.e_g = to_text(simulated.e_g);
  result.e_hid = to_text(simulated.e_hid);
  result.iterations_per_step =
      static_cast<double>(simulated.integration.sweeps) / static_cast<double>(simulated.integration.steps);
  result.cpu_seconds = simulated.integration.cpu_seconds;
  return result;
}

}  // namespace

RunResult run(const RunRequest& request, const RunHooks& hooks) {
  return with_scalar(request.precision, [&]<Scalar S>() { return run_in<S>(request, hooks); });
}

}  // namespace hbvm
