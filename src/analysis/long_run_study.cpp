#include <fmt/format.h>

#include <memory>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "hbvm/analysis/run.hpp"

namespace hbvm {
namespace {

std::string to_three_digits(const std::string& text) {
  BigFloat x(200);
  mpfr_set_str(raw(x), text.c_str(), 10, MPFR_RNDN);
  char* digits = nullptr;
  mpfr_asprintf(&digits, "%.2Re", raw(x));
  const std::unique_ptr<char, void (*)(char*)> owner(digits, mpfr_free_str);
  return digits;
}

Agreement check(const Experiment& experiment, const Table& table, const std::vector<RunResult>& results) {
  Agreement agreement;
  const ExpectedCsv expected(experiment.folder / "expected.csv");
  agreement.what = "stated bounds";
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
        ++agreement.stated;
        if (upper ? value_of(computed) <= value_of(limit) : value_of(computed) >= value_of(limit))
          ++agreement.agreed;
        else
          agreement.complaints.push_back(place + name + " is " + computed + (upper ? ", above " : ", below ") + limit);
      };
      bound("e_H", results[n].e_H, expected.cell(row, "e_H_min"), false);
      bound("e_H", results[n].e_H, expected.cell(row, "e_H_max"), true);
      bound("e_g", results[n].e_g, expected.cell(row, "e_g_max"), true);
    }
  }
  return agreement;
}

}  // namespace

Findings long_run_study(const Experiment& experiment, TomlTable& top) {
  Findings findings;
  Table& table = findings.table;
  const Expression step = top.number("step");
  table.columns = {"k", "s", "until", "e_H", "e_g", "e_hid", "output_delta_H", "iterations per step", "seconds"};
  table.groups.emplace_back();
  const auto runs = top.tables("run");
  std::vector<RunResult> results;
  for (const toml::table* entry : runs) {
    TomlTable reader(top.source(), *entry, "run");
    const RunRequest request{experiment.scene,
                             stated_method(reader),
                             SolverKind::fixed_point,
                             step,
                             reader.number("until"),
                             experiment.precision,
                             false};
    reader.finish();
    const RunResult result = hbvm::run(request, {});
    const auto three = [](const std::string& text) { return to_three_digits(text); };
    table.groups.back().rows.push_back({letter(request.method, "k"), letter(request.method, "s"), request.until.text(),
                                        three(result.e_H), three(result.e_g), three(result.e_hid),
                                        three(result.output_delta_H), fmt::format("{:.1f}", result.iterations_per_step),
                                        fmt::format("{:.2f}", result.cpu_seconds)});
    results.push_back(result);
    experiment.progress(static_cast<long>(results.size()), static_cast<long>(runs.size()));
  }
  if (experiment.check) findings.agreement = check(experiment, table, results);
  return findings;
}

}  // namespace hbvm
