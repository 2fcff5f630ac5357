#include "cost/cost_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cost/measuring_system.hpp"
#include "cost/pareto.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"

namespace hbvm::core {
namespace {

/// 10^x in three digits, also where double has no such number.
std::string power_text(double log10) {
  if (!std::isfinite(log10)) return "---";
  double exponent = std::floor(log10);
  double leading = std::pow(10, log10 - exponent);
  constexpr double rounds_up = double{9'995} / 1'000;
  if (leading >= rounds_up) {
    leading = 1;
    exponent += 1;
  }
  return fmt::format("{:.2f}e{:+03d}", leading, static_cast<int>(exponent));
}

std::string seconds_text(double seconds) { return std::isfinite(seconds) ? fmt::format("{:.3g}", seconds) : "---"; }

/// Whether each finding is on the front of all of its precision.
std::vector<bool> on_front(const CostStudy& study, const std::vector<CostFinding>& findings) {
  std::vector<bool> result(findings.size(), false);
  const std::vector<double> seconds = corrected_seconds(findings);
  std::map<std::string, std::vector<std::size_t>> by_precision;
  for (std::size_t i = 0; i < findings.size(); ++i)
    if (findings[i].measured.failure.empty()) by_precision[findings[i].cell.precision.name()].push_back(i);
  for (const auto& [name, places] : by_precision) {
    std::vector<CostPoint> points;
    for (const std::size_t i : places) points.push_back({seconds[i], findings[i].measured.errors.of(study.quantity)});
    for (const std::size_t n : pareto_front(points)) result[places[n]] = true;
  }
  return result;
}

}  // namespace

std::vector<double> slowdowns(const std::vector<CostFinding>& findings) {
  std::map<std::string, std::vector<double>> loops;
  for (const CostFinding& f : findings)
    if (f.measured.calibration > 0) loops[f.cell.precision.name()].push_back(f.measured.calibration);
  for (auto& [name, values] : loops) std::sort(values.begin(), values.end());
  std::vector<double> result;
  for (const CostFinding& f : findings) {
    const auto& values = loops[f.cell.precision.name()];
    result.push_back(f.measured.calibration > 0 ? f.measured.calibration / values[values.size() / 2] : 1);
  }
  return result;
}

std::vector<double> corrected_seconds(const std::vector<CostFinding>& findings) {
  // Below that the loop's own time is no more certain than the run's.
  constexpr double certain = double{1} / 10;
  const std::vector<double> slower = slowdowns(findings);
  std::vector<double> result;
  for (std::size_t i = 0; i < findings.size(); ++i)
    result.push_back(findings[i].measured.seconds / (std::abs(slower[i] - 1) > certain ? slower[i] : double{1}));
  return result;
}

std::vector<CsvColumn> cost_columns() {
  return {{"precision", CsvType::text, "working precision"},
          {"method", CsvType::text, "as listed"},
          {"made_by", CsvType::text, "with its k as chosen"},
          {"order", CsvType::integer, "of q and the output state; 0 if it is not known"},
          {"steps", CsvType::integer, ""},
          {"step", CsvType::text, "exact"},
          {"error_q", CsvType::decimal, "relative, at the end"},
          {"error_p", CsvType::decimal, "relative, of the output state"},
          {"error_lambda", CsvType::decimal, "relative, of the output state"},
          {"error_p_raw", CsvType::decimal, "relative, as propagated"},
          {"error_lambda_raw", CsvType::decimal, "relative, as propagated"},
          {"seconds", CsvType::binary64, "of the processor, in steps: median, corrected by the loop beside"},
          {"spread", CsvType::binary64, "half of the range of the repetitions, of the median"},
          {"slowdown", CsvType::binary64, "of the loop beside, over its median in this precision"},
          {"repetitions", CsvType::integer, "that count"},
          {"disturbed", CsvType::integer, "repetitions that do not count"},
          {"setup_seconds", CsvType::binary64, "coefficients and the choice of k"},
          {"sweeps", CsvType::integer, "over the stage equations"},
          {"evaluations", CsvType::integer, "of forces"},
          {"operations", CsvType::integer, "in the working precision"},
          {"operations_in_double", CsvType::integer, "beside these"},
          {"bytes", CsvType::integer, "held by coefficients and stepper"},
          {"front", CsvType::text, "yes: in this precision nothing is both quicker and more precise"},
          {"failure", CsvType::text, "why there is no result"}};
}

std::vector<CsvColumn> further_cost_columns(const Table& table) {
  const std::vector<CsvColumn> known{
      {"method", CsvType::text, "as listed"},
      {"made_by", CsvType::text, "with its k as chosen"},
      {"precision", CsvType::text, "working precision"},
      {"steps", CsvType::integer, ""},
      {"step", CsvType::text, "exact"},
      {"seconds", CsvType::binary64, "of the processor: of a step, or of all steps of a run"},
      {"operations", CsvType::integer, "of a step, in the working precision"},
      {"log10_error_H", CsvType::binary64, "of the greatest error of H relative to the size of its terms"},
      {"log10_round_off", CsvType::binary64, "of what rounding explains of it"}};
  std::vector<CsvColumn> columns;
  for (const std::string& name : csv_columns(table))
    columns.push_back(*std::find_if(known.begin(), known.end(), [&](const CsvColumn& c) { return c.name == name; }));
  return columns;
}

std::vector<Figure> cost_figures(const CostStudy& study, const CostOutcome& outcome) {
  std::vector<Figure> figures{work_precision_figure(study, outcome), digits_figure(study, outcome),
                              breakdown_figure(study, outcome)};
  // Of those of which no run came to its end there is nothing to see.
  const auto add = [&](Figure figure) {
    const auto& panels = figure.panels;
    if (std::any_of(panels.begin(), panels.end(), [](const Panel& panel) { return !panel.curves.empty(); }))
      figures.push_back(std::move(figure));
  };
  add(step_time_figure(study, outcome.step_times));
  if (outcome.energy_until) add(energy_figure(study, *outcome.energy_until, outcome.energies));
  add(conserving_figure(study, outcome.conserving));
  return figures;
}

Table cost_table(const CostStudy& study, const CostOutcome& outcome) {
  Table table;
  table.caption = fmt::format("What accuracy costs: {} to t = {}", study.scene.name, study.until.text());
  const std::vector<CsvColumn> columns = cost_columns();
  table.key_columns = {columns.front().name};
  for (std::size_t i = 1; i < columns.size(); ++i) table.columns.push_back(columns[i].name);
  const std::vector<CostFinding>& findings = outcome.findings;
  const std::vector<double> seconds = corrected_seconds(findings), slower = slowdowns(findings);
  const std::vector<bool> front = on_front(study, findings);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const CostCell& cell = findings[i].cell;
    const CostMeasurement& m = findings[i].measured;
    const std::string precision = cell.precision.name();
    if (table.groups.empty() || table.groups.back().heading != precision)
      table.groups.push_back({precision, {precision}, {}});
    std::vector<std::string> row{cell.method->text(), m.method, std::to_string(cell.method->order()),
                                 std::to_string(cell.steps), step_text(study.until, cell.steps)};
    if (m.failure.empty()) {
      for (const double error : {m.errors.q, m.errors.p, m.errors.lambda, m.raw.p, m.raw.lambda})
        row.push_back(power_text(error));
      for (const double number : {seconds[i], m.spread, slower[i]}) row.push_back(seconds_text(number));
      row.push_back(std::to_string(m.repetitions));
      row.push_back(std::to_string(m.disturbed));
      row.push_back(seconds_text(m.setup_seconds));
      row.push_back(std::to_string(m.sweeps));
      for (const std::uint64_t count : {m.evaluations, m.operations, m.operations_in_double})
        row.push_back(std::to_string(count));
      row.push_back(std::to_string(m.bytes));
      row.emplace_back(front[i] ? "yes" : "");
      row.emplace_back("");
    } else {
      row.resize(table.columns.size() - 1);
      row.push_back(m.failure);
    }
    table.groups.back().rows.push_back(std::move(row));
  }
  return table;
}

Table cheapest_table(const CostStudy& study, const CostOutcome& outcome) {
  Table table;
  table.caption = fmt::format("The least time for so many right digits of {}", name_of(study.quantity));
  table.columns = {"digits", "method", "precision", "step", "error", "seconds"};
  table.groups.push_back({fmt::format("{} to t = {}, the least time for so many right digits of {}", study.scene.name,
                                      study.until.text(), name_of(study.quantity)),
                          {},
                          {}});
  const std::vector<double> seconds = corrected_seconds(outcome.findings);
  for (const double digits : {2,  3,  4,  5,   6,   8,   10,  12,  14,  16,    20,    25,    30,   40,
                              50, 60, 80, 100, 150, 200, 300, 500, 700, 1'000, 2'000, 3'000, 5'000}) {
    if (digits < study.least_digits || digits > study.most_digits) continue;
    const CostFinding* best = nullptr;
    double least = 0;
    for (std::size_t i = 0; i < outcome.findings.size(); ++i) {
      const CostMeasurement& m = outcome.findings[i].measured;
      if (!m.failure.empty() || !(m.errors.of(study.quantity) <= -digits) || (best && seconds[i] >= least)) continue;
      best = &outcome.findings[i];
      least = seconds[i];
    }
    std::vector<std::string> row{fmt::format("{}", digits), "none", "", "", "", ""};
    if (best)
      row = {row.front(),
             best->measured.method,
             best->cell.precision.name(),
             step_text(study.until, best->cell.steps),
             power_text(best->measured.errors.of(study.quantity)),
             seconds_text(least)};
    table.groups.back().rows.push_back(std::move(row));
  }
  return table;
}

std::string to_json(const CostStudy& study, const CostOutcome& outcome, const std::string& command) {
  using Json = OrderedJson;
  Json system = Json::object();
  for (const auto& [key, value] : measuring_system()) system[key] = value;
  Json json{{"version", version()},
            {"command", command},
            {"scene", study.scene.name},
            {"until", study.until.text()},
            {"quantity", name_of(study.quantity)},
            {"digits_lost", outcome.nature.digits_lost},
            {"reference", {{"digits", outcome.reference.digits}, {"source", outcome.reference.source}}},
            {"system", system},
            {"cells_of_all", outcome.cells}};
  json["cells"] = Json::array();
  const std::vector<double> seconds = corrected_seconds(outcome.findings), slower = slowdowns(outcome.findings);
  const std::vector<bool> front = on_front(study, outcome.findings);
  for (std::size_t i = 0; i < outcome.findings.size(); ++i) {
    const CostCell& cell = outcome.findings[i].cell;
    const CostMeasurement& m = outcome.findings[i].measured;
    Json entry{{"method", cell.method->text()}, {"made_by", m.method},
               {"order", cell.method->order()}, {"precision", cell.precision.name()},
               {"steps", cell.steps},           {"step", step_text(study.until, cell.steps)}};
    if (!m.failure.empty()) {
      entry["failure"] = m.failure;
      json["cells"].push_back(entry);
      continue;
    }
    const auto log10_of = [](const CostErrors& e) {
      return Json{{"q", json_number(e.q)}, {"p", json_number(e.p)}, {"lambda", json_number(e.lambda)}};
    };
    entry["log10_error"] = log10_of(m.errors);
    entry["log10_error_raw"] = log10_of(m.raw);
    entry["seconds"] = json_number(seconds[i]);
    entry["spread"] = json_number(m.spread);
    entry["slowdown"] = json_number(slower[i]);
    entry["repetitions"] = m.repetitions;
    entry["disturbed"] = m.disturbed;
    entry["setup_seconds"] = json_number(m.setup_seconds);
    entry["sweeps"] = m.sweeps;
    entry["evaluations"] = m.evaluations;
    entry["operations"] = m.operations;
    entry["operations_in_double"] = m.operations_in_double;
    entry["bytes"] = m.bytes;
    entry["front"] = static_cast<bool>(front[i]);
    json["cells"].push_back(entry);
  }
  return dumped(json, 1);
}

}  // namespace hbvm::core
