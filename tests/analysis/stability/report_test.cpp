#include "hbvm/analysis/stability/report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace hbvm {
namespace {

using Json = nlohmann::json;

CaseFinding finding(CaseVerdict verdict = CaseVerdict::holds) {
  CaseFinding f{"family", "a case", "mass 1e-8", "quad", "holds", verdict, {}, "", 3};
  f.result.criteria = {{"units", double{10} / 3, 40}, {"other", 1, 50}};
  f.result.warnings = {"energy_lost"};
  f.result.message = "worst coordinate q_3";
  return f;
}
CaseFinding failure() {
  CaseFinding f = finding(CaseVerdict::typed_failure);
  f.result = {{}, {}, "stage_equations_diverge", "step 1: \"so\"\nand so"};
  f.reason = "why";
  return f;
}

std::map<std::string, CaseFinding> read(const std::string& text) {
  std::istringstream lines(text);
  return read_case_lines(lines);
}

TEST(CaseLines, AreReadBackToTheLastBit) {
  CaseFinding odd = finding(CaseVerdict::not_as_expected);
  odd.result.criteria[0].value = std::numeric_limits<double>::quiet_NaN();
  const auto found = read(to_line(finding(), "a") + "\n" + to_line(failure(), "b") + "\n" + to_line(odd, "c") + "\n");
  ASSERT_EQ(found.size(), 3u);
  const CaseFinding& a = found.at("a");
  EXPECT_EQ(a.verdict, CaseVerdict::holds);
  EXPECT_EQ(a.result.criteria.at(0).value, double{10} / 3);
  EXPECT_EQ(a.result.criteria.at(1).bound, 50);
  EXPECT_EQ(a.result.warnings, finding().result.warnings);
  EXPECT_EQ(a.result.message, finding().result.message);
  EXPECT_EQ(a.family + a.name + a.parameter + a.precision + a.expected, "familya casemass 1e-8quadholds");
  EXPECT_EQ(found.at("b").verdict, CaseVerdict::typed_failure);
  EXPECT_EQ(found.at("b").result.failure, "stage_equations_diverge");
  EXPECT_EQ(found.at("b").result.message, failure().result.message);
  EXPECT_EQ(found.at("b").reason, "why");
  EXPECT_EQ(found.at("c").verdict, CaseVerdict::not_as_expected);
  EXPECT_FALSE(found.at("c").result.criteria.at(0).holds());
}

TEST(CaseLines, ThatAreCutOffOrOfAnotherVersionAreLeftOut) {
  const std::string whole = to_line(finding(), "whole") + "\n", last = to_line(finding(), "last");
  for (std::size_t length = 0; length < last.size(); length += 7)
    EXPECT_EQ(read(whole + last.substr(0, length) + "\n" + whole).size(), 1u) << length;
  std::string other = to_line(finding(), "other");
  other.replace(other.find("\"version\":\"") + 11, 1, "x");
  EXPECT_TRUE(read(other).empty());
}

TEST(StabilityReport, JsonHasTheFigureThatDecides) {
  const Json json = Json::parse(to_json({finding(), failure()}, "hbvm stability"));
  const Json& cases = json.at("cases");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].at("case"), "a case");
  EXPECT_EQ(cases[0].at("parameter"), "mass 1e-8");
  EXPECT_EQ(cases[0].at("precision"), "quad");
  EXPECT_EQ(cases[0].at("expected"), "holds");
  EXPECT_EQ(cases[0].at("verdict"), "holds");
  EXPECT_EQ(cases[0].at("figure"), double{10} / 3);
  EXPECT_EQ(cases[0].at("bound"), 40);
  EXPECT_EQ(cases[1].at("verdict"), "typed failure, as expected");
  EXPECT_TRUE(cases[1].at("figure").is_null());
  EXPECT_TRUE(cases[1].at("bound").is_null());
}

TEST(StabilityReport, TableAndSummaryCountTheVerdicts) {
  const std::vector<CaseFinding> findings{finding(), failure(), finding(CaseVerdict::not_as_expected)};
  EXPECT_EQ(summary(findings), "3 cases: 1 hold, 1 fail as expected, 0 warn as expected, 1 is not as expected");
  const Table table = stability_table(findings);
  ASSERT_EQ(table.groups.size(), 1u);
  const auto& rows = table.groups[0].rows;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].size(), table.columns.size());
  EXPECT_EQ(rows[0].back(), "holds");
  EXPECT_EQ(rows[1][4], "stage_equations_diverge");
  EXPECT_EQ(rows[2].back(), "not as expected");
}

}  // namespace
}  // namespace hbvm
