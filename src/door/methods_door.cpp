#include <fmt/format.h>

#include "compare/method_pictures.hpp"
#include "door/door.hpp"
#include "door/run_of.hpp"
#include "hbvm/error.hpp"
#include "hbvm/run.hpp"
#include "hbvm/study.hpp"
#include "hbvm/table.hpp"
#include "long_work/json.hpp"
#include "scalar/text.hpp"
#include "scene/set_number.hpp"
#include "step/registry.hpp"

namespace hbvm {
namespace {

std::string command_of(const MethodsRequest& asked, const core::RunRequest& request) {
  std::string names;
  for (const std::string& method : asked.methods) names += " " + method;
  return "hbvm compare " + request.scene.name + core::settings_in_command(request.scene) + " --methods" + names +
         " --step '" + request.step.text() + "' --until '" + request.until.text() + "' --precision " +
         request.precision.name() + (asked.reference ? " --reference" : "");
}

bool has_constraints(const MethodComparison& comparison) {
  for (const MethodRun& run : comparison.runs)
    if (!run.e_g.empty() && (run.e_g != "0" || run.e_hid != "0")) return true;
  return false;
}

}  // namespace

MethodComparison compare_methods(const MethodsRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.methods.empty()) throw InputError("no method to compare is named");
  if (door.methods.size() > curve_colours.size())
    throw InputError(fmt::format("{} methods are more than the {} that a picture can tell apart", door.methods.size(),
                                 curve_colours.size()));
  const std::vector<core::NamedMethod> methods = core::named_methods(door.methods);
  RunRequest one{.scene = door.scene, .method = door.methods.front(), .step = door.step, .until = door.until};
  one.precision = door.precision;
  const core::RunRequest request = core::request_of(one, std::nullopt);
  std::vector<core::RecordedMethod> runs = core::run_methods(request, methods, door.progress);
  MethodComparison comparison;
  comparison.scene = request.scene.name;
  comparison.title = request.scene.title;
  comparison.step = request.step.text();
  comparison.until = request.until.text();
  comparison.precision = request.precision.name();
  comparison.command = command_of(door, request);
  if (door.reference) comparison.no_digits = core::count_digits(request, runs);
  if (door.picture) {
    comparison.figure = core::methods_figure(request, runs, comparison.command);
    comparison.page = core::methods_page(request, runs, comparison.command);
  }
  for (core::RecordedMethod& run : runs) comparison.runs.push_back(std::move(run.figures));
  return comparison;
}

std::string to_text(const MethodComparison& comparison) {
  const auto error = [](const std::string& text) { return text.empty() ? text : core::to_scientific(text, 3); };
  const bool constrained = has_constraints(comparison);
  bool has_digits = false;
  for (const MethodRun& run : comparison.runs) has_digits = has_digits || run.digits.has_value();
  Table table;
  table.columns = {"method", "e_H"};
  if (constrained) table.columns.insert(table.columns.end(), {"e_g", "e_hid"});
  if (has_digits) table.columns.emplace_back("digits");
  table.columns.emplace_back("seconds");
  Table::Group group{.heading = fmt::format("{}: {} to t = {}, step {}, {}", comparison.scene, comparison.title,
                                            comparison.until, comparison.step, comparison.precision),
                     .keys = {},
                     .rows = {}};
  std::string below;
  for (const MethodRun& run : comparison.runs) {
    std::vector<std::string> row{run.method, error(run.e_H)};
    if (constrained) row.insert(row.end(), {error(run.e_g), error(run.e_hid)});
    if (has_digits) row.push_back(run.digits ? fmt::format("{:.1f}", *run.digits) : "");
    row.push_back(run.failure.empty() ? fmt::format("{:.2g}", run.cpu_seconds) : "");
    group.rows.push_back(row);
    if (run.resolved != run.method) below += run.method + ": this is " + run.resolved + "\n";
    if (!run.failure.empty()) below += run.method + ": " + run.failure + "\n";
    for (const Warning& warning : run.warnings)
      below += fmt::format("{}: WARNING {}: {}\n", run.method, warning.name, warning.text);
  }
  table.groups.push_back(group);
  return to_text(table) + below +
         (comparison.no_digits.empty() ? "" : "no digits are known: " + comparison.no_digits + "\n");
}

std::string to_json(const MethodComparison& comparison) {
  core::OrderedJson runs = core::OrderedJson::array();
  for (const MethodRun& run : comparison.runs) {
    core::OrderedJson one{{"method", run.method}, {"resolved", run.resolved}};
    if (!run.failure.empty()) {
      one["failure"] = run.failure;
    } else {
      one.update({{"e_H", run.e_H}, {"e_g", run.e_g}, {"e_hid", run.e_hid}});
      if (run.digits) one["digits"] = *run.digits;
      one["cpu_seconds"] = run.cpu_seconds;
      one["warnings"] = core::json_of(run.warnings);
    }
    runs.push_back(std::move(one));
  }
  core::OrderedJson json{{"scene", comparison.scene},
                         {"step", comparison.step},
                         {"until", comparison.until},
                         {"precision", comparison.precision},
                         {"runs", runs}};
  if (!comparison.no_digits.empty()) json["no_digits"] = comparison.no_digits;
  json["command"] = comparison.command;
  return core::dumped(json, 2);
}

}  // namespace hbvm
