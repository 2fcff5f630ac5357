#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "long_work/json.hpp"
#include "run/scene_run.hpp"
#include "scalar/text.hpp"
#include "scene/observe.hpp"
#include "scene/varied_scene.hpp"

namespace hbvm::core {
namespace {

/// One point of the grid: a value of each swept number, and the run there.
struct SweepPoint {
  std::vector<double> at;
  RunRequest request;
};

/// What is kept of a run: its errors, and of each observation the value at the end, the least and the greatest.
struct SweepRun {
  std::vector<std::string> errors, observed;
  std::string failure;
};

constexpr const char* error_columns[] = {"e_H", "e_g", "e_hid"};

std::string short_number(double x) { return fmt::format("{:.6g}", x); }

std::string to_result(const RunRequest& request) {
  try {
    const Run made = run(request, {});
    OrderedJson observed = OrderedJson::array();
    for (const Observation& o : made.observations)
      for (const std::string& number : {o.value, o.least, o.greatest}) observed.push_back(number);
    return dumped({{"errors", {made.e_H, made.e_g, made.e_hid}}, {"observed", observed}}, -1);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {  // the other points are worth as much without this one
    return dumped({{"failure", error.what()}}, -1);
  }
}

SweepRun read_sweep_run(const std::string& text) {
  return read_json(text, "a run of a sweep", [](const OrderedJson& j) {
    if (j.contains("failure")) return SweepRun{{}, {}, j.at("failure")};
    return SweepRun{j.at("errors"), j.at("observed"), {}};
  });
}

/// [[sweep]]: set = "L", and values = [...], or from, to and count.
VariedNumber read_swept(TomlTable reader) {
  VariedNumber swept{reader.string("set"), {}};
  reader.rename("sweep of '" + swept.name + "'");
  if (reader.has("values")) {
    const toml::node& node = reader.require("values");
    if (!node.is_array() || node.as_array()->empty()) reader.fail(node, "'values' is no list of numbers");
    swept.values = reader.to_vector(node, node.as_array()->size(), "values");
  } else {
    const Expression from = reader.number("from"), to = reader.number("to");
    const long count = reader.integer("count");
    constexpr long most = 1'000'000;
    if (count < 2 || count > most) reader.fail("'count' is not between 2 and 10^6");
    swept.values = values_between(from, to, count);
  }
  reader.finish();
  return swept;
}

std::vector<SweepPoint> points_of(const RunRequest& request, const std::vector<VariedNumber>& swept) {
  std::vector<SweepPoint> points;
  for (const VariedScene& varied : varied_scenes(request.scene, swept)) {
    points.push_back({varied.near(), request});
    points.back().request.scene = varied.scene;
  }
  return points;
}

/// What a sweep found, in the order of its points.
struct Sweep {
  std::vector<std::string> swept, observed;  ///< names of the columns
  std::vector<SweepPoint> points;
  std::vector<SweepRun> runs;
};

/// One column of the observed against the number swept last, a curve for each value of the others. Without
/// observations it is an error.
Panel panel_of(const Sweep& sweep, const std::string& name, std::size_t column) {
  const bool of_errors = sweep.observed.empty();
  Panel panel;
  panel.title = plain(name);
  panel.x.label = plain(sweep.swept.back());
  panel.y = {plain(name), of_errors ? AxisScale::decimal : AxisScale::linear};
  panel.labels_beside = true;
  std::vector<double> others;
  for (std::size_t n = 0; n < sweep.runs.size(); ++n) {
    const std::vector<double> before(sweep.points[n].at.begin(), sweep.points[n].at.end() - 1);
    if (panel.curves.empty() || before != others) {
      std::string label;
      for (std::size_t i = 0; i < before.size(); ++i)
        label += (i > 0 ? ", " : "") + sweep.swept[i] + " = " + short_number(before[i]);
      panel.curves.push_back({plain(label), {}, true});
      others = before;
    }
    const SweepRun& run = sweep.runs[n];
    const std::vector<std::string>& numbers = of_errors ? run.errors : run.observed;
    if (!run.failure.empty()) continue;
    const double y = value_of(numbers[column]);
    panel.curves.back().points.push_back({sweep.points[n].at.back(), of_errors ? std::log10(y) : y});
  }
  std::erase_if(panel.curves, [](const Curve& curve) { return curve.points.empty(); });
  return panel;
}

Figure figure_of(const Sweep& sweep, const Experiment& experiment) {
  Figure figure;
  figure.name = "sweep";
  figure.caption = plain(experiment.scene.title);
  figure.footnote = experiment.provenance[0] + ", " + experiment.provenance[1];
  if (sweep.observed.empty()) {
    figure.panels.push_back(panel_of(sweep, error_columns[0], 0));
  } else {
    for (std::size_t i = 0; i < sweep.observed.size(); ++i)
      figure.panels.push_back(panel_of(sweep, sweep.observed[i], i));
  }
  return figure;
}

/// Bounds of expected.csv: columns of the swept numbers, and NAME_min or NAME_max of any column.
StudyOutcome check(const Experiment& experiment, const Table& table, const Sweep& sweep) {
  StudyOutcome outcome;
  outcome.what = "stated bounds";
  const ExpectedCsv expected(experiment.folder / "expected.csv");
  for (const auto& stated : expected.rows)
    for (const std::vector<std::string>& row : table.groups.front().rows) {
      bool is_meant = true;
      for (std::size_t i = 0; i < sweep.swept.size(); ++i)
        is_meant = is_meant && value_of(row[i]) == value_of(expected.cell(stated, sweep.swept[i]));
      for (std::size_t i = sweep.swept.size(); is_meant && i < row.size(); ++i)
        for (const bool upper : {false, true}) {
          const std::string limit = expected.cell(stated, table.columns[i] + (upper ? "_max" : "_min"));
          if (limit.empty()) continue;
          const bool is_met =
              row[i] != "---" && (upper ? value_of(row[i]) <= value_of(limit) : value_of(row[i]) >= value_of(limit));
          outcome.count(is_met, table.columns[i] + " is " + row[i] + (upper ? ", above " : ", below ") + limit);
        }
    }
  return outcome;
}

Findings conclude(const Experiment& experiment, const Sweep& sweep) {
  Findings findings;
  Table& table = findings.table;
  table.columns = sweep.swept;
  table.columns.insert(table.columns.end(), std::begin(error_columns), std::end(error_columns));
  table.columns.insert(table.columns.end(), sweep.observed.begin(), sweep.observed.end());
  table.groups.emplace_back();
  findings.full = table;
  findings.numbers = table.columns;
  Drawn drawn;
  std::size_t failed = 0;
  for (std::size_t n = 0; n < sweep.runs.size(); ++n) {
    const SweepRun& run = sweep.runs[n];
    std::vector<std::string> row, full, place;
    for (std::size_t i = 0; i < sweep.swept.size(); ++i) {
      row.push_back(short_number(sweep.points[n].at[i]));
      full.push_back(to_text(sweep.points[n].at[i]));
      place.push_back(sweep.swept[i] + " = " + row.back());
    }
    constexpr int digits = 6;
    for (const std::vector<std::string>* numbers : {&run.errors, &run.observed})
      for (const std::string& number : *numbers) {
        row.push_back(numbers == &run.errors ? to_scientific(number, 3) : rounded_text(number, digits));
        full.push_back(number);
      }
    row.resize(table.columns.size(), "---");
    full.resize(table.columns.size(), "---");
    table.groups.front().rows.push_back(row);
    findings.full.groups.front().rows.push_back(full);
    if (run.failure.empty()) continue;
    ++failed;
    drawn.warnings.push_back(fmt::format("{}: {}", fmt::join(place, ", "), run.failure));
  }
  if (failed == sweep.runs.size()) throw Error("every run of the sweep failed; " + drawn.warnings.front());
  if (experiment.check) findings.outcome = check(experiment, table, sweep);
  draw(experiment, figure_of(sweep, experiment), drawn);
  findings.outcome.files = std::move(drawn.files);
  findings.outcome.warnings = std::move(drawn.warnings);
  return findings;
}

}  // namespace

Part<Findings> sweep_study(const Experiment& experiment, TomlTable& top) {
  // Read before the step, for which 'sweep' would be taken as misspelt where there is none.
  const auto sweeps = top.tables("sweep");
  RunRequest request{experiment.scene,
                     parse_method(top.string("method")),
                     SolverKind::automatic,
                     top.number("step"),
                     top.number("until"),
                     experiment.precision,
                     false};
  for (const toml::table* table : top.tables("observe")) {
    TomlTable reader(top.source(), *table, "observe");
    const std::string name = reader.string("name");
    request.scene = with_observation(request.scene, name, reader.string("value"));
    reader.finish();
  }
  std::vector<VariedNumber> swept;
  for (const toml::table* table : sweeps) swept.push_back(read_swept(TomlTable(top.source(), *table, "sweep")));
  if (swept.empty()) top.fail("a sweep has a table [[sweep]] for each number that it changes");
  Sweep sweep{{}, {}, points_of(request, swept), {}};
  for (const VariedNumber& number : swept) sweep.swept.push_back(number.name);
  for (const SceneObservation& o : request.scene.observations)
    for (const char* of : {"", "_least", "_greatest"}) sweep.observed.push_back(o.name + of);
  Part<Findings> part;
  for (const SweepPoint& point : sweep.points)
    part.cells.push_back({experiment.key("sweep", point.request.scene, point.request.method->key(), point.request.step,
                                         point.request.until, ""),
                          [of = point.request] { return to_result(of); }});
  part.conclude = [&experiment, sweep](const std::vector<std::string>& results) {
    Sweep done = sweep;
    for (const std::string& result : results) done.runs.push_back(read_sweep_run(result));
    return conclude(experiment, done);
  };
  return part;
}

}  // namespace hbvm::core
