#include "hard_cases/case.hpp"

#include <gtest/gtest.h>

#include "hard_cases/measured.hpp"
#include "hard_cases/not_finite.hpp"

namespace hbvm::core {
namespace {

HardCase hard_case(const Expected& expected) {
  return {"family", "case", "parameter", "double", expected, 1, [] { return CaseResult{}; }};
}
CaseResult failed(const std::string& cause) { return {{}, {}, cause, "what was seen"}; }

CaseVerdict verdict(const Expected& expected, const CaseResult& result) {
  return judge(hard_case(expected), result).verdict;
}

const Expected to_hold;
const Expected to_fail{false, {"stage_equations_diverge"}, {}, {}};
const Expected either{true, {"stage_equations_diverge"}, {}, {}};
const Expected honest{true, {}, {"energy_lost"}, {}};
const Expected to_warn{true, {}, {}, "near_singular_constraints"};

TEST(Judge, HoldsWithinTheBound) {
  for (const double value : {0., 1., 2.}) EXPECT_EQ(verdict(to_hold, measured(value)), CaseVerdict::holds) << value;
  EXPECT_EQ(verdict(to_hold, measured(0, 0)), CaseVerdict::holds);
  EXPECT_EQ(verdict(either, measured(1)), CaseVerdict::holds);
  EXPECT_EQ(judge(hard_case(to_hold), measured(1)).reason, "");
}

TEST(Judge, AWrongNumberIsNotAsExpected) {
  for (const double value : {2.01, 1e300, infinity, nan_value})
    for (const Expected& expected : {to_hold, either, honest, to_warn, to_fail})
      EXPECT_EQ(verdict(expected, measured(value)), CaseVerdict::not_as_expected) << value << expected.text();
  EXPECT_EQ(verdict(to_hold, measured(1, 0)), CaseVerdict::not_as_expected);
  EXPECT_EQ(verdict(to_hold, measured(1, nan_value)), CaseVerdict::not_as_expected);
  EXPECT_EQ(judge(hard_case(to_hold), measured(3)).reason, "figure is 3, above 2");
}

TEST(Judge, EveryCriterionCounts) {
  CaseResult two = measured(1);
  two.criteria.push_back({"other", 9, 8});
  const CaseFinding finding = judge(hard_case(to_hold), two);
  EXPECT_EQ(finding.verdict, CaseVerdict::not_as_expected);
  EXPECT_EQ(finding.deciding()->what, "other");
  two.criteria[1].value = 7;
  EXPECT_EQ(verdict(to_hold, two), CaseVerdict::holds);
  EXPECT_EQ(judge(hard_case(to_hold), two).deciding()->what, "other") << "7 of 8 is nearer to its bound than 1 of 2";
  two.criteria[1].value = nan_value;
  EXPECT_EQ(verdict(to_hold, two), CaseVerdict::not_as_expected);
}

TEST(Judge, NothingMeasuredIsNotAsExpected) {
  EXPECT_EQ(verdict(to_hold, {}), CaseVerdict::not_as_expected);
  EXPECT_EQ(verdict(to_fail, {}), CaseVerdict::not_as_expected);
  EXPECT_EQ(judge(hard_case(to_hold), {}).reason, "nothing was measured");
}

TEST(Judge, AFailureMustBeTheOneThatIsExpected) {
  EXPECT_EQ(verdict(to_fail, failed("stage_equations_diverge")), CaseVerdict::typed_failure);
  EXPECT_EQ(verdict(either, failed("stage_equations_diverge")), CaseVerdict::typed_failure);
  for (const Expected& expected : {to_fail, either, to_hold, to_warn, honest})
    EXPECT_EQ(verdict(expected, failed("near_singular_constraints")), CaseVerdict::not_as_expected);
  EXPECT_EQ(verdict(to_fail, measured(1)), CaseVerdict::not_as_expected) << "it should have failed";
}

TEST(Judge, AWarningExcusesWhereItMayAndMustBeGivenWhereItIsExpected) {
  CaseResult warned = measured(3);
  warned.warnings = {"energy_lost"};
  EXPECT_EQ(verdict(honest, warned), CaseVerdict::warned);
  EXPECT_EQ(verdict(to_hold, warned), CaseVerdict::not_as_expected);
  warned.criteria[0].value = 1;
  EXPECT_EQ(verdict(honest, warned), CaseVerdict::holds);
  EXPECT_EQ(verdict(to_warn, warned), CaseVerdict::not_as_expected) << "another warning";
  warned.warnings.emplace_back("near_singular_constraints");
  EXPECT_EQ(verdict(to_warn, warned), CaseVerdict::holds);
  EXPECT_EQ(verdict(to_warn, measured(1)), CaseVerdict::not_as_expected) << "no warning";
}

TEST(Expected, IsSaidInWords) {
  EXPECT_EQ(to_hold.text(), "holds");
  EXPECT_EQ(to_fail.text(), "stage_equations_diverge");
  EXPECT_EQ(either.text(), "holds or stage_equations_diverge");
  EXPECT_EQ(honest.text(), "holds or warns energy_lost");
  EXPECT_EQ(to_warn.text(), "holds, warning near_singular_constraints");
}

}  // namespace
}  // namespace hbvm::core
