#include "run/scene_run.hpp"

#include <algorithm>

#include "integrate/energy_scale.hpp"
#include "integrate/event_finder.hpp"
#include "integrate/momentum_drift.hpp"
#include "integrate/observations.hpp"
#include "integrate/output_state.hpp"
#include "integrate/states_at.hpp"
#include "integrate/trajectory.hpp"
#include "integrate/work_done.hpp"
#include "linear/vector_text.hpp"
#include "run/error_estimate.hpp"
#include "run/health.hpp"
#include "run/horizon.hpp"
#include "run/proved_run.hpp"
#include "run/shadow.hpp"
#include "run/simulate.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/coordinate_names.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
class Progress final : public Observer<S> {
 public:
  Progress(const std::function<void(long, long)>& report, long steps) : report_(report), steps_(steps) {}
  void observe(const Snapshot<S>& snapshot) override {
    if (report_) report_(snapshot.n, steps_);
  }
  void remember(Archive&) override {}

 private:
  const std::function<void(long, long)>& report_;
  long steps_;
};

/// The conserved components of the momenta that the scene names.
template <Scalar S>
std::vector<MomentumComponent<S>> observed_momenta(const Scene& text, const Assembled<S>& scene) {
  const bool linear = text.observes("linear_momentum"), angular = text.observes("angular_momentum");
  if (!linear && !angular) return {};
  std::vector<MomentumComponent<S>> components = conserved_momenta(scene.problem);
  std::erase_if(components, [&](const MomentumComponent<S>& c) { return c.is_linear() ? !linear : !angular; });
  return components;
}

/// What the chosen k came to: judged by the energy over the whole run, and by the steps for which no k was enough.
template <Scalar S>
NodesReport report_nodes(const RunStepper<S>& stepper, const TimeGrid<S>& grid, const EnergyScale<S>& scale,
                         const S& e_H) {
  const NodeLog& log = stepper.nodes();
  NodesReport report;
  report.k = stepper.chosen()->k;
  report.r = stepper.chosen()->r;
  report.because = stepper.chosen()->reason;
  for (const NodeLog::Raise& raise : log.raised)
    report.raised.push_back({to_text(grid.time(raise.step)), raise.k, raise.r});
  const long substeps = stepper.halving() ? stepper.halving()->substeps : 0;
  const bool conserved = e_H <= scale.round_off(grid.steps() + substeps);
  report.verified = conserved && log.unresolved == 0;
  report.verdict = conserved ? "energy conserved to round-off over the run"
                             : "energy NOT conserved: e_H = " + to_scientific(e_H, 3) + ", " +
                                   to_scientific(S(e_H / scale.size()), 3) + " of the terms of H";
  if (log.unresolved > 0)
    report.verdict += std::string(conserved ? ", but" : ";") + " from t = " + to_text(grid.time(log.first_unresolved)) +
                      " on there are steps that no number of nodes integrates to round-off: take a smaller step";
  else if (!conserved)
    report.verdict += "; more nodes do not help: take a smaller step";
  return report;
}

template <Scalar S>
HalvingReport report_halving(const HalvingLog& log, const TimeGrid<S>& grid) {
  HalvingReport report{log.steps, log.substeps, log.depth, to_text(S(grid.step() / S(1L << log.depth))), {}};
  if (log.steps > 0) report.first_t = to_text(grid.time(log.first_step));
  return report;
}

/// The file of a trajectory, which a run that goes on continues.
template <Scalar S>
class KeptFile final : public Observer<S> {
 public:
  explicit KeptFile(CsvFile& file) : file_(file) {}
  void observe(const Snapshot<S>&) override {}
  void remember(Archive& archive) override { archive(file_); }

 private:
  CsvFile& file_;
};

/// The scene at the state that its first step is made from.
template <Scalar S>
Assembled<S> seen_by_stepper(const Assembled<S>& scene, Direction direction) {
  Assembled<S> seen = scene;
  if (direction == Direction::backward) seen.p0 = -seen.p0;
  return seen;
}

/// What `integrate` returns. Where it fails after the motion had been lost, that is the cause, and it says so.
template <Scalar S, class Integrate>
Simulated<S> explained(HealthWatch<S>& health, Integrate&& integrate) {
  try {
    return integrate();
  } catch (const StepError& error) {
    const std::string lost = health.lost();
    if (lost.empty()) throw;
    throw StepError(error, lost);
  } catch (const RedundancyLost& error) {
    const std::string lost = health.lost();
    if (lost.empty()) throw;
    throw RedundancyLost(error.what() + ("; before, " + lost), error.constraint(), error.time());
  } catch (const NotFinite& error) {
    const std::string lost = health.lost();
    if (lost.empty()) throw;
    throw NotFinite(error.place(), lost);
  }
}

/// What is told of a run as it was asked for.
Run told_of(const RunRequest& request) {
  Run run;
  run.scene = request.scene.name;
  run.title = request.scene.title;
  run.scene_toml = write_scene(request.scene);
  run.solver = name_of(request.solver);
  run.precision = request.precision.name();
  run.reverse = request.direction == Direction::backward;
  if (request.start) run.start = request.start->file;
  run.q_names = coordinate_names(request.scene);
  run.p_names = coordinate_names(request.scene, "p");
  run.observes = !request.scene.observables.empty();
  return run;
}

/// The work of each effect, constraint and moving point that does some.
template <Scalar S>
std::vector<Work> works_of(const Problem<S>& problem, const Vector<S>& p) {
  std::vector<Work> works;
  for (const std::size_t n : working(problem))
    works.push_back({problem.driven[n].name, to_text(work_done(problem, {n}, p))});
  return works;
}

/// Of each event and direction that came three times or more.
template <Scalar S>
std::vector<EventPeriod> periods_of(const Scene& scene, const std::vector<FoundEvent<S>>& found) {
  std::vector<EventPeriod> periods;
  constexpr std::size_t fewest = 3;
  for (std::size_t event = 0; event < scene.events.size(); ++event)
    for (const bool rises : {true, false}) {
      std::vector<S> times;
      for (const FoundEvent<S>& one : found)
        if (one.event == event && one.rises == rises && !one.grazes) times.push_back(magnitude(one.state.t));
      if (times.size() < fewest) continue;
      S least = times[1] - times[0], greatest = least;
      for (std::size_t n = 2; n < times.size(); ++n) {
        const S passed = times[n] - times[n - 1];
        if (passed < least) least = passed;
        if (passed > greatest) greatest = passed;
      }
      periods.push_back(
          {scene.events[event].name, rises, static_cast<long>(times.size()), to_text(least), to_text(greatest)});
    }
  return periods;
}

/// The times at which the state is asked for, which ascend, each once.
template <Scalar S>
std::vector<S> times_asked(const RunRequest& request, const TimeGrid<S>& grid) {
  std::vector<S> times;
  if (request.every_time)
    times = multiples_until<S>(evaluate<S>(*request.every_time, request.scene.constants), grid.until());
  for (const Expression& asked : request.at) {
    times.push_back(evaluate<S>(asked, request.scene.constants));
    if (!(times.back() >= 0) || times.back() > grid.until())
      throw InputError("--at: '" + asked.text() + "' is no time from 0 to the end, " + to_text(grid.until()));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

template <Scalar S>
Run run_in(const RunRequest& request, const RunHooks& hooks) {
  if (request.prove) check_provable(request);
  const TimeGrid<S> grid(request.step, request.until, request.scene.constants, request.direction,
                         request.prove ? LastStep::refused : LastStep::shortened);
  const std::vector<S> asked_times = times_asked(request, grid);
  Assembled<S> scene = assemble<S>(request.scene);
  Course<S> course{{}, hooks.checkpoints};
  if (request.start && !scene.problem.is_conservative())
    throw InputError("--start: '" + request.scene.name +
                     "' has forces without a potential, or names t: such a motion begins at t = 0 of its scene");
  if (request.start) {
    course.start = evaluate(*request.start, request.scene, scene);
    scene.q0 = course.start->q;
    scene.p0 = course.start->p;
  }
  if (course.checkpoints && (!asked_times.empty() || !request.scene.events.empty()))
    throw InputError("--checkpoint: a run that tells events, or states at times of its own, cannot be kept");
  std::optional<DigitsLost> horizon;
  if (request.horizon) horizon = digits_lost(request, {});
  if (hooks.recording && horizon && horizon->failure.empty()) hooks.recording->horizon = horizon;
  std::unique_ptr<CsvFile> csv = hooks.open_csv ? hooks.open_csv() : nullptr;
  Run result = told_of(request);
  result.lambda_names = names_of_constraints(scene.problem);
  const Assembled<S> seen = seen_by_stepper(scene, request.direction);
  RunStepper<S> stepper(seen, request.method, grid.step(), request.solver, request.on_failure);
  const Method& method = *stepper.method();
  result.method = method.text();

  Progress<S> progress(hooks.progress, grid.steps());
  std::vector<Observer<S>*> observers{&progress};
  std::optional<Observations<S>> observations;
  if (!request.scene.observations.empty()) observers.push_back(&observations.emplace(request.scene, scene.problem));
  const Observations<S>* const observed = observations ? &*observations : nullptr;
  std::optional<Trajectory<S>> trajectory;
  std::optional<KeptFile<S>> kept_file;
  std::ostream* const lines = csv ? csv.get() : hooks.trajectory;
  if (lines) {
    const auto columns = trajectory_columns(request.scene, result.lambda_names);
    if (hooks.describe_csv) hooks.describe_csv(columns);
    trajectory.emplace(scene.problem, *lines, hooks.every, grid.steps(), names_of(columns), observed);
    observers.push_back(&*trajectory);
    if (csv) observers.push_back(&kept_file.emplace(*csv));
  }
  std::optional<MotionRecorder<S>> recorder;
  if (hooks.recording) observers.push_back(&recorder.emplace(scene.problem, grid.steps(), *hooks.recording, observed));
  if (hooks.recording)
    for (const SceneObservation& observation : request.scene.observations)
      hooks.recording->observations.push_back(observation.name);
  MomentumDrift<S> momenta(scene.problem, observed_momenta(request.scene, scene));
  if (!momenta.components().empty()) observers.push_back(&momenta);
  HealthWatch<S> health(scene.problem, method, grid);
  observers.push_back(&health);
  std::optional<ShadowedRun<S>> shadowed;
  if (request.shadow) observers.push_back(&shadowed.emplace(scene.problem.mass.of_bodies(), grid.steps()));
  std::optional<EnergyScale<S>> scale;
  if (stepper.chosen()) observers.push_back(&scale.emplace(scene.problem));
  std::optional<BetweenSteps<S>> between;
  std::optional<StatesAt<S>> states_at;
  std::optional<EventFinder<S>> events;
  if (!asked_times.empty() || !request.scene.events.empty())
    between.emplace(method.make_stepper<S>(scene.problem, request.solver));
  if (!request.scene.events.empty())
    observers.push_back(&events.emplace(request.scene, scene.problem, *between, request.until_event));
  if (!asked_times.empty()) {
    observers.push_back(&states_at.emplace(*between, asked_times, request.direction));
  }
  Account account;
  const Simulated<S> simulated = explained(health, [&] {
    return simulate<S>(scene, stepper, grid, observers, request.account ? &account : nullptr, &health.decay(), course);
  });

  if (csv) csv->flush();
  if (states_at) states_at->finish();

  const Snapshot<S>& end = simulated.integration.end;
  if (scale) result.nodes = report_nodes(stepper, grid, *scale, simulated.e_B);
  if (stepper.halving()) result.halving = report_halving(*stepper.halving(), grid);
  result.start_settled = scene.settled;
  result.step = to_text(grid.step());
  if (!grid.is_even()) result.last_step = to_text(grid.last_step());
  result.until = to_text(grid.until());
  result.t = to_text(end.t);
  result.steps = grid.steps();
  const Index bodies = scene.problem.mass.of_bodies();
  const auto of_bodies = [&](const Vector<S>& x) { return Vector<S>(x.head(bodies)); };
  result.q = to_texts(of_bodies(end.q));
  result.p = to_texts(of_bodies(end.p));
  RedundantConstraints<S> redundant(scene.problem);
  result.lambda = to_texts(redundant.multipliers(end.q, end.lambda));
  result.q_carry = to_texts(of_bodies(simulated.state.q_carry));
  result.p_carry = to_texts(of_bodies(simulated.state.p_carry));
  StateEvaluator<S> point(scene.problem);
  const OutputState<S> output = output_state(point, end.q, end.p);
  result.output_p = to_texts(of_bodies(output.p));
  const Vector<S> output_lambda = redundant.multipliers(end.q, output.lambda);
  result.output_lambda = to_texts(output_lambda);
  result.output_delta_H = to_text(S(point.energy(end.q, output.p) - simulated.H0));
  const auto multipliers_of = [&](const StateBetween<S>& state) {
    return to_texts(redundant.multipliers(state.q, state.lambda));
  };
  if (events)
    for (const FoundEvent<S>& event : events->found())
      result.events.push_back({request.scene.events[event.event].name, to_text(event.state.t), event.rises,
                               event.grazes, to_texts(of_bodies(event.state.q)), to_texts(of_bodies(event.state.p)),
                               multipliers_of(event.state), to_texts(event.observed)});
  if (events) result.periods = periods_of(request.scene, events->found());
  if (states_at)
    for (const StateBetween<S>& state : states_at->states())
      result.at.push_back({to_text(state.t), to_texts(of_bodies(state.q)), to_texts(of_bodies(state.p)),
                           multipliers_of(state), to_text(S(point.energy(state.q, state.p) - simulated.H0))});
  result.e_H = to_text(simulated.e_H);
  if (!scene.problem.driven.empty()) {
    result.e_B = to_text(simulated.e_B);
    result.work = to_text(S(-point.account(output.p)));
    result.works = works_of(scene.problem, output.p);
  }
  result.e_g = to_text(simulated.e_g);
  result.e_hid = to_text(simulated.e_hid);
  result.iterations_per_step =
      static_cast<double>(simulated.integration.sweeps) / static_cast<double>(simulated.integration.steps);
  for (std::size_t i = 0; i < request.scene.observations.size(); ++i) {
    const auto at = static_cast<Index>(i);
    const auto &least = observed->least(), &greatest = observed->greatest();
    result.observations.push_back({request.scene.observations[i].name, request.scene.observations[i].value.text(),
                                   to_text(observed->values()[at]), to_text(least.values[at]), to_text(least.times[at]),
                                   to_text(greatest.values[at]), to_text(greatest.times[at])});
  }
  result.health = health.report(*request.method, method, stepper.halving());
  for (const Redundancy& redundancy : scene.redundant)
    result.health.warnings.push_back(
        {"redundant_constraints", to_text(redundancy) + " at the start; they were violated by up to " +
                                      to_scientific(simulated.redundancy, 3) + " of their terms"});
  if (shadowed) result.shadow = shadowed->compare(request, method, course.start);
  if (horizon && result.shadow) horizon->measured_t = result.shadow->gone_t;
  result.health.horizon = std::move(horizon);
  if (request.prove) result.proved = prove_run<S>(request, method, stepper.nodes(), simulated.state, hooks.progress);
  if (request.error)
    result.error = estimate_error(request, method, course.start, of_bodies(end.q), of_bodies(output.p), output_lambda);
  result.cpu_seconds = simulated.integration.cpu_seconds;
  result.account = entries_of(account);
  if (hooks.account) *hooks.account = std::move(account);
  if (request.scene.observes("energy"))
    result.observables.push_back({"energy", to_text(simulated.H0), to_text(simulated.e_H)});
  for (std::size_t i = 0; i < momenta.components().size(); ++i)
    result.observables.push_back(
        {momenta.components()[i].name(), to_text(momenta.initial(i)), to_text(momenta.drift(i))});
  return result;
}

}  // namespace

Run run(const RunRequest& request, const RunHooks& hooks) {
  return with_scalar(request.precision, [&]<Scalar S>() {
    if (!request.until_event) return run_in<S>(request, hooks);
    // Where it comes is known when a run has gone by. Another one ends there.
    RunRequest until_there = request;
    until_there.until_event.reset();
    try {
      RunRequest search = request;
      search.account = search.shadow = search.horizon = search.error = search.prove = false;
      search.at.clear();
      search.every_time.reset();
      RunHooks quiet;
      quiet.progress = hooks.progress;
      run_in<S>(search, quiet);
    } catch (const EventReached& event) {
      until_there.until = Expression::parse(event.t);
    }
    return run_in<S>(until_there, hooks);
  });
}

}  // namespace hbvm::core
