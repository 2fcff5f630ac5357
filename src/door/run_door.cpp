#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "door/door.hpp"
#include "door/run_of.hpp"
#include "door/trajectory_lines.hpp"
#include "hbvm/error.hpp"
#include "hbvm/run.hpp"
#include "hbvm/version.hpp"
#include "reference/usual_step.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "run/scene_run.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/assemble.hpp"
#include "scene/observe.hpp"
#include "scene/set_number.hpp"
#include "scene/sketch.hpp"
#include "step/registry.hpp"

namespace hbvm {
namespace core {

/// That of a run without one. The step is told by few digits, in which nearly every start is consistent: whether the
/// scene's is, the run's own precision decides first.
Expression step_that_suits(const Scene& scene, const Expression& until, const std::string& precision) {
  with_scalar(Precision::parse(precision), [&]<Scalar S>() { static_cast<void>(assemble<S>(scene)); });
  return usual_step(scene, until);
}

/// "turn" or "turn,3". \throws InputError for an event that there is not
LastEvent last_event(const Scene& scene, const std::string& text) {
  const std::size_t comma = text.rfind(',');
  const std::string name = text.substr(0, comma), count = comma == std::string::npos ? "1" : text.substr(comma + 1);
  const auto found = std::find_if(scene.events.begin(), scene.events.end(),
                                  [&](const SceneEvent& event) { return event.name == name; });
  if (found == scene.events.end()) throw InputError("until_event: there is no event '" + name + "'");
  constexpr std::size_t most_digits = 9;
  if (count.empty() || count.size() > most_digits || count.find_first_not_of("0123456789") != std::string::npos ||
      std::stol(count) < 1)
    throw InputError("until_event: '" + text + "' is not of the form NAME or NAME,3");
  return {static_cast<std::size_t>(found - scene.events.begin()), std::stol(count)};
}

RunRequest request_of(const hbvm::RunRequest& asked, const std::optional<std::string>& start) {
  Scene scene = scene_of(asked.scene);
  for (const auto& [across, up] : asked.portraits)
    for (const std::string& quantity : {across, up})
      if (std::none_of(scene.observations.begin(), scene.observations.end(),
                       [&](const SceneObservation& known) { return known.name == quantity; }))
        scene = with_observation(scene, quantity, quantity);
  const Expression until = expression_of(asked.until, "until");
  RunRequest request{scene,
                     parse_method(asked.method),
                     parse_solver(asked.solver),
                     asked.step ? expression_of(*asked.step, "step") : step_that_suits(scene, until, asked.precision),
                     until,
                     Precision::parse(asked.precision),
                     asked.account,
                     asked.shadow,
                     asked.error,
                     asked.prove,
                     parse_on_failure(asked.on_failure),
                     asked.reverse ? Direction::backward : Direction::forward};
  request.horizon = asked.horizon;
  request.linear_energy = asked.linear_energy;
  for (const auto& [across, up] : asked.portraits) request.portraits.push_back({across, up});
  for (const Number& time : asked.at) request.at.push_back(expression_of(time, "at"));
  if (asked.every_time) request.every_time = expression_of(*asked.every_time, "every_time");
  if (asked.until_event) request.until_event = last_event(scene, *asked.until_event);
  if (start) request.start = read_start_state(asked.start, *start);
  return request;
}

/// The options of times between mesh points.
std::string times_in_command(const hbvm::RunRequest& asked) {
  std::string at;
  for (const Number& time : asked.at) at += (at.empty() ? " --at '" : ",") + time.text();
  return (at.empty() ? at : at + "'") + (asked.every_time ? " --every-time '" + asked.every_time->text() + "'" : "") +
         (asked.until_event ? " --until-event '" + *asked.until_event + "'" : "");
}

std::string command_of(const hbvm::RunRequest& asked, const RunRequest& request) {
  return "hbvm run " + request.scene.name + settings_in_command(request.scene) + " --method " + request.method->text() +
         " --step '" + request.step.text() + "' --until '" + request.until.text() + "' --precision " +
         request.precision.name() + " --solver " + std::string(name_of(request.solver)) +
         (request.start ? " --start " + request.start->file : "") + (asked.reverse ? " --reverse" : "") +
         (request.on_failure == OnFailure::halve ? " --on-failure halve" : "") + times_in_command(asked);
}

Figure figure_of(const RunRequest& request, const Recording& recording, const std::string& command) {
  Figure figure = run_figure(sketch(request.scene, recording.until_lost().states()), recording, request.portraits,
                             request.linear_energy);
  figure.caption = plain(request.scene.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + command;
  if (recording.every > 1)
    figure.footnote +=
        fmt::format("; a point every {} steps, of errors the greatest since the one before", recording.every);
  return figure;
}

std::vector<Figure> frames_of(const RunRequest& request, const Recording& recording) {
  std::vector<Figure> frames = motion_frames(sketch(request.scene, recording.until_lost().states()), recording);
  for (Figure& frame : frames) frame.caption = plain(request.scene.title);
  return frames;
}

}  // namespace core

Run run(const RunRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.every < 0)
    throw InputError(fmt::format("a trajectory of every {} steps: it must not be negative", door.every));
  const auto start = door.start.empty() ? std::nullopt : std::optional<std::string>("start.json");
  const core::RunRequest request = core::request_of(door, start);
  core::TrajectoryLines lines;
  std::ostream kept(&lines);
  core::Recording recording;
  core::RunHooks hooks;
  hooks.progress = door.progress;
  if (door.every > 0) {
    hooks.trajectory = &kept;
    hooks.every = door.every;
  }
  if (door.picture || door.frames) hooks.recording = &recording;
  Run run = [&] {
    try {
      return core::run(request, hooks);
    } catch (const Error&) {
      if (hbvm::Trajectory so_far = lines.take(); door.cut_short && !so_far.rows.empty())
        door.cut_short(std::move(so_far));
      throw;
    }
  }();
  run.command = core::command_of(door, request);
  run.trajectory = lines.take();
  if (door.picture) {
    run.figure = core::figure_of(request, recording, run.command);
    run.page = core::run_page(request, recording, run.command);
  }
  if (door.frames) run.frames = core::frames_of(request, recording);
  return run;
}

std::string usual_step(const Scene& scene, const Number& until) {
  return core::usual_step(core::scene_of(scene), core::expression_of(until, "until")).text();
}

std::vector<std::string> Trajectory::text(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) {
    std::string names;
    for (const std::string& name : columns) names += (names.empty() ? "" : ", ") + name;
    throw InputError("a trajectory has no column '" + column + "'; there are: " + (names.empty() ? "none" : names));
  }
  const auto at = static_cast<std::size_t>(found - columns.begin());
  std::vector<std::string> cells;
  for (const std::vector<std::string>& row : rows) cells.push_back(row[at]);
  return cells;
}

std::vector<double> Trajectory::values(const std::string& column) const {
  std::vector<double> numbers;
  for (const std::string& cell : text(column)) numbers.push_back(std::strtod(cell.c_str(), nullptr));
  return numbers;
}

}  // namespace hbvm
