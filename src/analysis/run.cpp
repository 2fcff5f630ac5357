#include "hbvm/analysis/run.hpp"

#include <ostream>

#include "hbvm/analysis/choose_k.hpp"
#include "hbvm/analysis/simulate.hpp"
#include "hbvm/integrate/momentum_drift.hpp"
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

/// The conserved components of the momenta that the scene names.
template <Scalar S>
std::vector<MomentumComponent<S>> observed_momenta(const Scene& text, const Assembled<S>& scene) {
  const bool linear = text.observes("linear_momentum"), angular = text.observes("angular_momentum");
  if (!linear && !angular) return {};
  std::vector<MomentumComponent<S>> components = conserved_momenta(scene.problem);
  std::erase_if(components, [&](const MomentumComponent<S>& c) { return c.is_linear() ? !linear : !angular; });
  return components;
}

template <Scalar S>
RunResult run_in(const RunRequest& request, const RunHooks& hooks) {
  const TimeGrid<S> grid(request.step, request.until, request.scene.constants);
  const Assembled<S> scene = assemble<S>(request.scene);
  std::unique_ptr<std::ostream> csv = hooks.open_csv ? hooks.open_csv() : nullptr;
  RunResult result;
  result.method = request.method;
  if (request.method.is_auto()) {
    const ChosenK chosen = choose_k(scene, request.method.s, grid.step(), request.solver);
    result.method.k = chosen.k;
    result.chosen_because = chosen.reason;
  }
  const Hbvm<S> method = make_hbvm<S>(result.method.k, result.method.s);

  Progress<S> progress(hooks.progress, grid.steps());
  std::vector<Observer<S>*> observers{&progress};
  std::optional<Trajectory<S>> trajectory;
  if (csv) {
    trajectory.emplace(scene.problem, *csv, hooks.every, grid.steps(), hooks.provenance);
    observers.push_back(&*trajectory);
  }
  MomentumDrift<S> momenta(scene.problem, observed_momenta(request.scene, scene));
  if (!momenta.components().empty()) observers.push_back(&momenta);
  HealthWatch<S> health(scene.problem, result.method.s, grid);
  observers.push_back(&health);
  std::optional<ShadowedRun<S>> shadowed;
  if (request.shadow) observers.push_back(&shadowed.emplace(scene.problem.m(), grid.steps()));
  const Simulated<S> simulated = simulate(scene, method, request.solver, grid, observers,
                                          request.account ? &result.account : nullptr, &health.decay());

  if (csv && !csv->flush()) throw InputError("cannot write '" + hooks.csv_name + "': is the disk full?");

  const Snapshot<S>& end = simulated.integration.end;
  if (request.method.is_auto() && !degree_of_U(scene.problem))
    result.choice_verified = quadrature_defect(scene.problem, result.method.k, result.method.s, grid.step(),
                                               request.solver, end.q, end.p) <= 1;
  result.step = to_text(grid.step());
  result.t = to_text(end.t);
  result.steps = grid.steps();
  result.q = texts(end.q);
  result.p = texts(end.p);
  RedundantConstraints<S> redundant(scene.problem);
  result.lambda = texts(redundant.multipliers(end.q, end.lambda));
  Point<S> point(scene.problem);
  const OutputState<S> output = output_state(point, end.q, end.p);
  result.output_p = texts(output.p);
  result.output_lambda = texts(redundant.multipliers(end.q, output.lambda));
  result.output_delta_H = to_text(S(point.energy(end.q, output.p) - simulated.H0));
  result.e_H = to_text(simulated.e_H);
  result.e_g = to_text(simulated.e_g);
  result.e_hid = to_text(simulated.e_hid);
  result.iterations_per_step =
      static_cast<double>(simulated.integration.sweeps) / static_cast<double>(simulated.integration.steps);
  result.health = health.report(result.method);
  for (const Redundancy& redundancy : scene.redundant)
    result.health.warnings.push_back(
        {"redundant_constraints", to_text(redundancy) + " at the start; they were violated by up to " +
                                      to_scientific(simulated.redundancy, 3) + " of their terms"});
  if (shadowed)
    result.shadow = shadowed->compare(request.scene, result.method, request.solver, request.step, request.until);
  result.cpu_seconds = simulated.integration.cpu_seconds;
  if (request.scene.observes("energy"))
    result.observables.push_back({"energy", to_text(simulated.H0), to_text(simulated.e_H)});
  for (std::size_t i = 0; i < momenta.components().size(); ++i)
    result.observables.push_back(
        {momenta.components()[i].name(), to_text(momenta.initial(i)), to_text(momenta.drift(i))});
  return result;
}

}  // namespace

RunResult run(const RunRequest& request, const RunHooks& hooks) {
  return with_scalar(request.precision, [&]<Scalar S>() { return run_in<S>(request, hooks); });
}

}  // namespace hbvm
