#include "hard_cases/report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"

namespace hbvm::core {
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

TEST(CaseResults, AreReadBackToTheLastBit) {
  const auto read = [](const CaseFinding& finding) { return read_case_result(to_result(finding)); };
  CaseFinding odd = finding(CaseVerdict::not_as_expected);
  odd.result.criteria[0].value = std::numeric_limits<double>::quiet_NaN();
  const CaseFinding a = read(finding()), b = read(failure()), c = read(odd);
  EXPECT_EQ(a.verdict, CaseVerdict::holds);
  EXPECT_EQ(a.result.criteria.at(0).value, double{10} / 3);
  EXPECT_EQ(a.result.criteria.at(1).bound, 50);
  EXPECT_EQ(a.result.warnings, finding().result.warnings);
  EXPECT_EQ(a.result.message, finding().result.message);
  EXPECT_EQ(a.family + a.name + a.parameter + a.precision + a.expected, "familya casemass 1e-8quadholds");
  EXPECT_EQ(b.verdict, CaseVerdict::typed_failure);
  EXPECT_EQ(b.result.failure, "stage_equations_diverge");
  EXPECT_EQ(b.result.message, failure().result.message);
  EXPECT_EQ(b.reason, "why");
  EXPECT_EQ(c.verdict, CaseVerdict::not_as_expected);
  EXPECT_FALSE(c.result.criteria.at(0).holds());
}

TEST(CaseResults, SayNothingOfTheTimeItTook) {
  CaseFinding other = finding();
  other.cpu_seconds = 4;
  EXPECT_EQ(to_result(other), to_result(finding()));
}

TEST(CaseResults, ThatAreNoneAreRefused) {
  for (const char* const text : {"", "{}", "[]", "{\"family\":1}"}) EXPECT_THROW(read_case_result(text), InputError);
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
  EXPECT_EQ(cases[0].at("cpu_seconds"), 3);
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
}  // namespace hbvm::core
