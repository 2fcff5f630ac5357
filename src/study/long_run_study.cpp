#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "long_work/json.hpp"
#include "run/scene_run.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// What is kept of a run.
struct LongRun {
  std::string e_H, e_g, e_hid, output_delta_H;
  double iterations_per_step;
};

std::string to_result(const Run& run) {
  return dumped({{"e_H", run.e_H},
                 {"e_g", run.e_g},
                 {"e_hid", run.e_hid},
                 {"output_delta_H", run.output_delta_H},
                 {"iterations_per_step", json_number(run.iterations_per_step)}},
                -1);
}
LongRun read_long_run(const std::string& text) {
  return read_json(text, "a long run", [](const OrderedJson& j) {
    return LongRun{j.at("e_H"), j.at("e_g"), j.at("e_hid"), j.at("output_delta_H"),
                   number_of(j.at("iterations_per_step"))};
  });
}

StudyOutcome check(const Experiment& experiment, const Table& table, const std::vector<LongRun>& results) {
  StudyOutcome outcome;
  const ExpectedCsv expected(experiment.folder / "expected.csv");
  outcome.what = "stated bounds";
  for (const auto& row : expected.rows) {
    for (std::size_t n = 0; n < results.size(); ++n) {
      const auto& cells = table.groups.back().rows[n];
      if (cells[0] != expected.cell(row, "k") || cells[1] != expected.cell(row, "s") ||
          cells[2] != expected.cell(row, "until"))
        continue;
      const std::string only = expected.cell(row, "only");
      if (!only.empty() && only != experiment.precision.name()) continue;
      const std::string place = "k = " + cells[0] + ", s = " + cells[1] + ", until " + cells[2] + ": ";
      const auto bound = [&](const char* name, const std::string& computed, const std::string& limit, bool upper) {
        if (limit.empty()) return;
        outcome.count(upper ? value_of(computed) <= value_of(limit) : value_of(computed) >= value_of(limit),
                      place + name + " is " + computed + (upper ? ", above " : ", below ") + limit);
      };
      bound("e_H", results[n].e_H, expected.cell(row, "e_H_min"), false);
      bound("e_H", results[n].e_H, expected.cell(row, "e_H_max"), true);
      bound("e_g", results[n].e_g, expected.cell(row, "e_g_max"), true);
    }
  }
  return outcome;
}

/// \param seconds that each run took, of those made now
Findings conclude(const Experiment& experiment, const std::vector<RunRequest>& requests,
                  const std::vector<std::string>& results, const std::vector<std::optional<double>>& seconds) {
  Findings findings;
  Table& table = findings.table;
  table.columns = {"k", "s", "until", "e_H", "e_g", "e_hid", "output_delta_H", "iterations per step", "seconds"};
  table.groups.emplace_back();
  findings.full = table;
  std::vector<LongRun> runs;
  for (std::size_t n = 0; n < requests.size(); ++n) {
    const RunRequest& request = requests[n];
    const LongRun& run = runs.emplace_back(read_long_run(results[n]));
    const auto add_row = [&](Table& to, const auto& shown, const char* iterations, const char* time) {
      to.groups.back().rows.push_back({letter(request.method, "k"), letter(request.method, "s"), request.until.text(),
                                       shown(run.e_H), shown(run.e_g), shown(run.e_hid), shown(run.output_delta_H),
                                       fmt::format(fmt::runtime(iterations), run.iterations_per_step),
                                       seconds[n] ? fmt::format(fmt::runtime(time), *seconds[n]) : "---"});
    };
    add_row(
        table, [](const std::string& x) { return to_scientific(x, 3); }, "{:.1f}", "{:.2f}");
    add_row(findings.full, std::identity(), "{}", "{}");
  }
  if (experiment.check) findings.outcome = check(experiment, table, runs);
  return findings;
}

}  // namespace

Part<Findings> long_run_study(const Experiment& experiment, TomlTable& top) {
  const Expression step = top.number("step");
  std::vector<RunRequest> requests;
  for (const toml::table* entry : top.tables("run")) {
    TomlTable reader(top.source(), *entry, "run");
    requests.push_back({experiment.scene, stated_method(reader), SolverKind::automatic, step, reader.number("until"),
                        experiment.precision, false});
    reader.finish();
  }
  // Times are no part of a result: they differ.
  const auto seconds = std::make_shared<std::vector<std::optional<double>>>(requests.size());
  Part<Findings> part;
  for (std::size_t n = 0; n < requests.size(); ++n)
    part.cells.push_back(
        {experiment.key("long run", experiment.scene, requests[n].method->key(), step, requests[n].until, ""),
         [request = requests[n], seconds, n] {
           const Run result = hbvm::core::run(request, {});
           (*seconds)[n] = result.cpu_seconds;
           return to_result(result);
         }});
  part.conclude = [&experiment, requests, seconds](const auto& results) {
    return conclude(experiment, requests, results, *seconds);
  };
  return part;
}

}  // namespace hbvm::core
