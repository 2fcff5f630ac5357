#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "csv_line.hpp"
#include "door/door.hpp"
#include "door/run_of.hpp"
#include "hbvm/run.hpp"
#include "hbvm/version.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "run/scene_run.hpp"
#include "scene/sketch.hpp"
#include "step/registry.hpp"

namespace hbvm {
namespace core {
namespace {

hbvm::Trajectory trajectory_of(std::istream& lines) {
  hbvm::Trajectory trajectory;
  for (std::string line; std::getline(lines, line);)
    if (trajectory.columns.empty())
      trajectory.columns = split_csv_line(line);
    else
      trajectory.rows.push_back(split_csv_line(line));
  return trajectory;
}

OperationList list_of(const OperationCounts& counts) {
  OperationList list;
  for (std::size_t op = 0; op < op_count; ++op)
    list.emplace_back(name_of(static_cast<Op>(op)), counts[static_cast<Op>(op)]);
  return list;
}

AccountEntry entry_of(const AccountLine& line) {
  AccountEntry entry{.name = line.name,
                     .effect = line.kind == AccountLine::Kind::effect,
                     .in_double = line.kind == AccountLine::Kind::in_double,
                     .calls = line.calls,
                     .evaluations = line.evaluations,
                     .operations = list_of(line.operations),
                     .done_before = {},
                     .seconds = line.seconds};
  if (line.done_before.total() > 0) entry.done_before = list_of(line.done_before);
  return entry;
}

}  // namespace

RunRequest request_of(const hbvm::RunRequest& asked, const std::optional<std::string>& start) {
  RunRequest request{scene_of(asked.scene),
                     parse_method(asked.method),
                     parse_solver(asked.solver),
                     expression_of(asked.step, "step"),
                     expression_of(asked.until, "until"),
                     Precision::parse(asked.precision),
                     asked.account,
                     asked.shadow,
                     asked.error,
                     parse_on_failure(asked.on_failure),
                     asked.reverse ? Direction::backward : Direction::forward};
  if (start) request.start = read_start_state(asked.start, *start);
  return request;
}

std::string command_of(const hbvm::RunRequest& asked, const RunRequest& request) {
  return "hbvm run " + asked.scene.name() + " --method " + request.method->text() + " --step '" + asked.step.text() +
         "' --until '" + asked.until.text() + "' --precision " + request.precision.name() + " --solver " +
         std::string(name_of(request.solver)) + (request.start ? " --start " + request.start->file : "") +
         (asked.reverse ? " --reverse" : "") + (request.on_failure == OnFailure::halve ? " --on-failure halve" : "");
}

Figure figure_of(const RunRequest& request, const Recording& recording, const std::string& command) {
  Figure figure = run_figure(sketch(request.scene), recording);
  figure.caption = plain(request.scene.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + command;
  if (recording.every > 1)
    figure.footnote +=
        fmt::format("; a point every {} steps, of errors the greatest since the one before", recording.every);
  return figure;
}

Run run_of(const RunRequest& request, const RunResult& result, const std::string& command) {
  Run run;
  run.scene = request.scene.name;
  run.title = request.scene.title;
  run.scene_toml = write_scene(request.scene);
  run.method = result.method->text();
  run.solver = name_of(request.solver);
  run.precision = request.precision.name();
  run.step = result.step;
  run.until = result.until;
  run.t = result.t;
  run.reverse = request.direction == Direction::backward;
  if (request.start) run.start = request.start->file;
  run.start_settled = result.settled;
  run.steps = result.steps;
  run.q = result.q;
  run.p = result.p;
  run.lambda = result.lambda;
  run.q_carry = result.q_carry;
  run.p_carry = result.p_carry;
  run.output_p = result.output_p;
  run.output_lambda = result.output_lambda;
  run.output_delta_H = result.output_delta_H;
  run.e_H = result.e_H;
  run.e_g = result.e_g;
  run.e_hid = result.e_hid;
  run.iterations_per_step = result.iterations_per_step;
  run.cpu_seconds = result.cpu_seconds;
  run.health = result.health;
  run.nodes = result.nodes;
  run.halving = result.halving;
  run.shadow = result.shadow;
  run.error = result.error;
  run.observes = !request.scene.observables.empty();
  run.observables = result.observables;
  if (request.account)
    for (const AccountLine& line : result.account.lines) run.account.push_back(entry_of(line));
  run.command = command;
  return run;
}

}  // namespace core

Run run(const RunRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.every < 0)
    throw InputError(fmt::format("a trajectory of every {} steps: it must not be negative", door.every));
  const auto start = door.start.empty() ? std::nullopt : std::optional<std::string>("start.json");
  const core::RunRequest request = core::request_of(door, start);
  std::stringstream lines;
  core::Recording recording;
  core::RunHooks hooks;
  hooks.progress = door.progress;
  if (door.every > 0) {
    hooks.trajectory = &lines;
    hooks.every = door.every;
  }
  if (door.picture) hooks.recording = &recording;
  const core::RunResult result = core::run(request, hooks);
  Run run = core::run_of(request, result, core::command_of(door, request));
  run.trajectory = core::trajectory_of(lines);
  if (door.picture) {
    run.figure = core::figure_of(request, recording, run.command);
    run.page = core::run_page(request, recording, run.command);
  }
  return run;
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
