#include "cost/cost_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cost/findings.hpp"
#include "cost/measuring_system.hpp"

namespace hbvm::core {
namespace {

std::vector<std::string> column(const Table& table, const std::string& name) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin();
  std::vector<std::string> cells;
  for (const Table::Group& group : table.groups)
    for (const auto& row : group.rows) cells.push_back(row.at(static_cast<std::size_t>(at)));
  return cells;
}

using Cells = std::vector<std::string>;

TEST(CostTable, HasARowACellAndMarksTheFront) {
  Given given = some_findings();
  CostFinding failed = given.outcome.findings.back();
  failed.cell.steps = 160;
  failed.measured.failure = "no end";
  given.outcome.findings.push_back(failed);
  const Table table = cost_table(given.study, given.outcome);
  EXPECT_EQ(csv_columns(table).size(), cost_columns().size());
  for (std::size_t i = 0; i < cost_columns().size(); ++i) EXPECT_EQ(csv_columns(table)[i], cost_columns()[i].name);
  EXPECT_EQ(column(table, "steps"), (Cells{"10", "100", "10", "20", "40", "80", "160"}));
  EXPECT_EQ(column(table, "front"), (Cells{"yes", "", "yes", "yes", "yes", "yes", ""}));
  EXPECT_EQ(column(table, "error_p").front(), "1.00e-03");
  EXPECT_EQ(column(table, "failure").back(), "no end");
  EXPECT_EQ(column(table, "error_q").back(), "");
}

TEST(CostTable, CorrectsTheTimeOfASlowMachine) {
  Given given = some_findings();
  given.outcome.findings[1].measured.calibration = 0.0015;
  given.outcome.findings[2].measured.calibration = 0.00105;
  const std::vector<double> seconds = corrected_seconds(given.outcome.findings);
  EXPECT_NEAR(seconds[1], 0.1 / slowdowns(given.outcome.findings)[1], 1e-12);
  EXPECT_LT(seconds[1], 0.08);
  // So little may be the loop's own.
  EXPECT_EQ(seconds[2], 0.02);
}

TEST(CheapestTable, NamesTheQuickestWithTheDigits) {
  const Given given = some_findings();
  const Table table = cheapest_table(given.study, given.outcome);
  const std::vector<std::string> digits = column(table, "digits"), seconds = column(table, "seconds"),
                                 methods = column(table, "method");
  const auto at = [&](const char* d) {
    return static_cast<std::size_t>(std::find(digits.begin(), digits.end(), d) - digits.begin());
  };
  EXPECT_EQ(seconds[at("2")], "0.01");
  EXPECT_EQ(methods[at("4")], "hbvm:4,4");
  EXPECT_EQ(seconds[at("4")], "0.02");
  EXPECT_EQ(seconds[at("14")], "2");
  EXPECT_EQ(methods[at("20")], "none");
}

TEST(CostJson, HoldsEveryCell) {
  const Given given = some_findings();
  const auto json = nlohmann::json::parse(to_json(given.study, given.outcome, "the command"));
  EXPECT_EQ(json.at("command"), "the command");
  ASSERT_EQ(json.at("cells").size(), 6u);
  EXPECT_EQ(json.at("cells").at(3).at("log10_error").at("p"), -10);
  EXPECT_EQ(json.at("cells").at(3).at("step"), "1/2");
  for (const char* const key : {"machine", "compiler", "flags", "libraries"})
    EXPECT_FALSE(json.at("system").at(key).get<std::string>().empty()) << key;
}

TEST(MeasuringSystem, KnowsItsCompiler) {
  for (const auto& [key, value] : measuring_system()) {
    if (key == "flags") {
      EXPECT_NE(value.find("-ffp-contract=off"), std::string::npos) << value;
    }
    EXPECT_EQ(value.find('@'), std::string::npos) << value;
  }
}

}  // namespace
}  // namespace hbvm::core
