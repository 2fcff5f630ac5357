#include <fmt/format.h>

#include <cmath>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "scalar/literal.hpp"
#include "study/step_halving.hpp"

namespace hbvm::core {
namespace {

struct Block {
  HalvingRequest request;
  std::vector<HalvingRow> rows;

  int runs() const { return request.last - request.first + 2; }
};

/// What a table of step halvings shows and is held against.
struct HalvingTable {
  std::string group;  ///< k or s
  std::vector<std::string> columns;
  std::vector<Block> blocks;
  std::string above_round_off;
  std::vector<std::string> round_off;
  std::map<std::string, Expression> orders;
};

/// Every printed figure above round-off, to all printed digits. Beyond double also that what was round-off in double is
/// round-off here, and that the rates double could not show (***) are there.
StudyOutcome check(const Experiment& experiment, const HalvingTable& table) {
  StudyOutcome outcome;
  const double above_round_off = value_of(table.above_round_off);
  const ExpectedCsv expected(experiment.folder / "expected.csv");
  const bool in_double = experiment.precision.kind() == Precision::Kind::binary64;
  outcome.what = "printed figures";
  for (const auto& printed : expected.rows) {
    const std::string k = expected.cell(printed, "k"), s = expected.cell(printed, "s"), i = expected.cell(printed, "i");
    const std::string place = "k = " + k + ", s = " + s + ", i = " + i + ": ";
    const HalvingRow* found = nullptr;
    for (const Block& block : table.blocks)
      for (const HalvingRow& row : block.rows)
        if (letter(block.request.method, "k") == k && letter(block.request.method, "s") == s &&
            std::to_string(row.i) == i)
          found = &row;
    for (std::size_t c = 0; c < expected.columns.size(); ++c) {
      const std::string& column = expected.columns[c];
      const std::string& figure = printed[c];
      if (column.starts_with("e_") && !figure.empty() && value_of(figure) > above_round_off) {
        const std::string computed = found ? found->cell(column) : "nothing";
        outcome.count(computed == figure, place + column + " is " + computed + ", printed " + figure);
      }
      if (in_double || !found) continue;
      if (figure == "***" && table.orders.contains(column)) {
        const Constants method{{"k", Expression::parse(k)}, {"s", Expression::parse(s)}};
        const double order = evaluate<double>(table.orders.at(column), method);
        const std::string computed = found->cell(column);
        outcome.count(computed != "***" && std::abs(value_of(computed) - order) <= value_of("1/10"),
                      place + column + " is " + computed + " instead of " + fmt::format("{}", order), true);
      }
    }
    if (in_double || !found) continue;
    for (const std::string& column : table.round_off)
      outcome.count(found->is_round_off(column), place + column + " is " + found->cell(column) + ", not round-off",
                    true);
  }
  return outcome;
}

HalvingTable read_table(const Experiment& experiment, TomlTable& top) {
  HalvingTable table;
  const Expression step = top.number("step"), until = top.number("until");
  table.group = top.string("group");
  if (table.group != "k" && table.group != "s") top.fail("'group' must be \"k\" or \"s\"");
  for (const std::string& column : top.strings("columns")) {
    HalvingRow().cell(column);  // refuses what is none
    table.columns.push_back(column);
  }
  for (const toml::table* entry : top.tables("block")) {
    TomlTable reader(top.source(), *entry, "block");
    HalvingRequest request{&experiment.scene,
                           stated_method(reader),
                           SolverKind::fixed_point,  // as the paper's: round-off columns depend on it
                           step,
                           until,
                           static_cast<int>(reader.integer("first")),
                           static_cast<int>(reader.integer("last"))};
    if (request.first < 0 || request.last < request.first || request.last > 40)
      reader.fail("'first' and 'last' must be 0 <= first <= last <= 40");
    reader.finish();
    table.blocks.push_back({request, {}});
  }
  table.round_off = top.strings("round_off");
  for (const std::string& column : table.round_off)
    if (column != "e_lambda" && column != "e_hid" && column != "e_g" && column != "e_H")
      top.fail(top.require("round_off"), "'round_off' has no column '" + column + "'");
  if (const toml::node* const node = top.take("orders")) {
    if (!node->is_table()) top.fail(*node, "'orders' must be a table");
    for (const auto& [column, order] : *node->as_table())
      table.orders.emplace(column.str(), top.to_number(order, "an order"));
  }
  table.above_round_off = top.number("compare_above").text();
  return table;
}

Findings conclude(const Experiment& experiment, HalvingTable table, const std::vector<std::string>& results) {
  Findings findings;
  findings.table.key_columns = {"k", "s"};
  findings.table.columns = {"i"};
  for (const std::string& column : table.columns) findings.table.columns.push_back(column);
  findings.full = findings.table;
  auto result = results.begin();
  for (Block& block : table.blocks) {
    std::vector<HalvingRun> runs;
    for (int n = 0; n < block.runs(); ++n) runs.push_back(read_halving_run(*result++));
    block.rows = halving_rows(block.request, runs, experiment.precision);
    const std::string k = letter(block.request.method, "k"), s = letter(block.request.method, "s");
    const auto cells_of = [&](const std::vector<HalvingRow>& rows) {
      std::vector<std::vector<std::string>> cells;
      for (const HalvingRow& row : rows) {
        cells.emplace_back();
        for (const std::string& column : findings.table.columns) cells.back().push_back(row.cell(column));
      }
      return cells;
    };
    findings.table.groups.push_back({table.group + " = " + (table.group == "k" ? k : s), {k, s}, cells_of(block.rows)});
    findings.full.groups.push_back(
        {"", {k, s}, cells_of(halving_rows(block.request, runs, experiment.precision, Digits::all))});
  }
  if (experiment.check) findings.outcome = check(experiment, table);
  return findings;
}

}  // namespace

/// The paper's tables: a run for each k, s and h.
Part<Findings> halving_study(const Experiment& experiment, TomlTable& top) {
  const HalvingTable table = read_table(experiment, top);
  Part<Findings> part;
  for (const Block& block : table.blocks) {
    const HalvingRequest& request = block.request;
    for (int i = request.first; i < request.first + block.runs(); ++i)
      part.cells.push_back(
          {experiment.key("step halving", experiment.scene, request.method->key(), request.step, request.until,
                          std::to_string(i)),
           [&experiment, request, i] { return to_result(halving_run(request, i, experiment.precision)); }});
  }
  part.conclude = [&experiment, table](const auto& results) { return conclude(experiment, table, results); };
  return part;
}

}  // namespace hbvm::core
