#include <algorithm>
#include <memory>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "long_work/json.hpp"
#include "scalar/text.hpp"
#include "study/conservation.hpp"
#include "study/step_halving.hpp"

namespace hbvm::core {
namespace {

using Kind = ConservedQuantity::Kind;

std::string to_result(const Conservation& found) {
  OrderedJson quantities = OrderedJson::array();
  for (const ConservedQuantity& q : found.quantities)
    quantities.push_back(
        {{"kind", static_cast<int>(q.kind)}, {"name", q.name}, {"drift", q.drift}, {"ulps", json_number(q.ulps)}});
  return dumped({{"k", found.method.k}, {"s", found.method.s}, {"steps", found.steps}, {"quantities", quantities}}, -1);
}
Conservation read_conservation(const std::string& text) {
  return read_json(text, "a study of conservation", [](const OrderedJson& j) {
    Conservation found{{j.at("k"), j.at("s")}, j.at("steps"), {}};
    for (const OrderedJson& q : j.at("quantities"))
      found.quantities.push_back(
          {static_cast<Kind>(q.at("kind").get<int>()), q.at("name"), q.at("drift"), number_of(q.at("ulps"))});
    return found;
  });
}

struct Row {
  std::string scene, nodes;
  std::string kept, lost;  ///< among H, g, P and L
};

/// Scene and nodes, the drifts of H, g, P and L (the greatest component's), the momenta, and which of the four are
/// kept.
std::vector<std::string> cells(const Conservation& found, Row& row, Digits digits) {
  std::vector<std::string> result{row.scene, row.nodes, std::to_string(found.method.k)};
  const auto append = [](std::string& text, const std::string& word) { text += (text.empty() ? "" : " ") + word; };
  std::string momenta;
  for (const auto& [kind, letter] : {std::pair(Kind::energy, "H"), std::pair(Kind::constraints, "g"),
                                     std::pair(Kind::linear_momentum, "P"), std::pair(Kind::angular_momentum, "L")}) {
    const ConservedQuantity* worst = nullptr;
    for (const ConservedQuantity& quantity : found.quantities) {
      if (quantity.kind != kind) continue;
      if (!worst || quantity.ulps > worst->ulps) worst = &quantity;
      if (kind == Kind::linear_momentum || kind == Kind::angular_momentum)
        momenta += (momenta.empty() ? "" : "; ") + quantity.name;
    }
    result.push_back(!worst ? "---" : digits == Digits::all ? worst->drift : to_scientific(worst->drift, 3));
    if (worst) append(worst->ulps <= found.round_off() ? row.kept : row.lost, letter);
  }
  const auto or_none = [](const std::string& text) { return text.empty() ? "---" : text; };
  for (const std::string& text : {momenta, row.kept, row.lost}) result.push_back(or_none(text));
  return result;
}

StudyOutcome check(const Experiment& experiment, const std::vector<Row>& rows) {
  StudyOutcome outcome;
  outcome.what = "stated verdicts";
  const ExpectedCsv expected(experiment.folder / "expected.csv");
  const bool in_double = experiment.precision.kind() == Precision::Kind::binary64;
  for (const auto& stated : expected.rows) {
    const std::string only = expected.cell(stated, "only");
    if (!only.empty() && (only == "double") != in_double) continue;
    const std::string scene = expected.cell(stated, "scene"), nodes = expected.cell(stated, "nodes");
    const std::string kept = expected.cell(stated, "kept"), lost = expected.cell(stated, "lost");
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.scene == scene && r.nodes == nodes; });
    const Row found = row == rows.end() ? Row() : *row;
    outcome.count(row != rows.end() && found.kept == kept && found.lost == lost,
                  scene + ", " + nodes + ": kept '" + found.kept + "', lost '" + found.lost + "' instead of '" + kept +
                      "' and '" + lost + "'");
  }
  return outcome;
}

constexpr std::pair<Nodes, const char*> both[] = {{Nodes::s, "k = s"}, {Nodes::more, "k > s"}};

Findings conclude(const Experiment& experiment, const std::vector<std::string>& results) {
  Findings findings;
  findings.table.columns = {"scene", "nodes", "k", "e_H", "e_g", "e_P", "e_L", "momenta", "kept", "lost"};
  findings.table.groups.emplace_back();
  findings.full = findings.table;
  std::vector<Row> rows;
  for (const auto& [name, text] : built_in_scenes()) {
    for (const auto& [nodes, label] : both) {
      Row row{name, label, {}, {}};
      const Conservation found = read_conservation(results[rows.size()]);
      Row full = row;
      findings.table.groups.back().rows.push_back(cells(found, row, Digits::printed));
      findings.full.groups.back().rows.push_back(cells(found, full, Digits::all));
      rows.push_back(std::move(row));
    }
  }
  if (experiment.check) findings.outcome = check(experiment, rows);
  return findings;
}

}  // namespace

/// Every built-in scene with k = s and with more nodes.
Part<Findings> conservation_study(const Experiment& experiment, TomlTable& top) {
  const Expression step = top.number("step"), until = top.number("until");
  const int s = static_cast<int>(top.integer("s"));
  HbvmName{s, s}.check();
  Part<Findings> part;
  for (const auto& [name, text] : built_in_scenes()) {
    const auto scene = std::make_shared<const Scene>(read_scene(text, name));
    for (const auto& [nodes, label] : both) {
      part.cells.push_back(
          {experiment.key("conservation, all digits", *scene, label, step, until, "s = " + std::to_string(s)),
           [&experiment, scene, s, nodes = nodes, step, until] {
             return to_result(conservation({scene.get(), s, nodes, step, until}, experiment.precision));
           }});
    }
  }
  part.conclude = [&experiment](const auto& results) { return conclude(experiment, results); };
  return part;
}

}  // namespace hbvm::core
