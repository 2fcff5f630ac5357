#include "hbvm/analysis/stability/stability.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <set>
#include <stdexcept>

#include "analysis/stability/measured.hpp"
#include "hbvm/analysis/stability/collection.hpp"

namespace hbvm {
namespace {

HardCase hard_case(const std::string& name, const std::function<CaseResult()>& run) {
  return {"family", name, "", "double", {}, 1, run};
}
CaseResult of_a_crash() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  return measured(0);
}
CaseResult of_a_hang() {
  volatile bool waiting = true;
  while (waiting) {
  }
  return measured(0);
}

TEST(Stability, FindingsStandInTheOrderOfTheCases) {
  std::vector<HardCase> cases;
  for (int i = 0; i < 9; ++i)
    cases.push_back(hard_case(std::to_string(i), [i] { return measured(i % 2 == 0 ? 1 + i / double{100} : 3); }));
  for (const int jobs : {1, 3, 20}) {
    StabilityOptions options;
    options.jobs = jobs;
    const auto findings = stability(cases, options);
    ASSERT_EQ(findings.size(), cases.size());
    for (int i = 0; i < 9; ++i) {
      const CaseFinding& f = findings[static_cast<std::size_t>(i)];
      EXPECT_EQ(f.name, std::to_string(i));
      EXPECT_EQ(f.verdict, i % 2 == 0 ? CaseVerdict::holds : CaseVerdict::not_as_expected);
      EXPECT_EQ(f.deciding()->value, i % 2 == 0 ? 1 + i / double{100} : 3) << "numbers survive to the last bit";
    }
  }
}

TEST(Stability, ACrashAHangAndAnExceptionTakeNoOtherCaseWithThem) {
  const auto findings = stability({hard_case("crash", of_a_crash), hard_case("hang", of_a_hang),
                                   hard_case("throws", []() -> CaseResult { throw std::runtime_error("odd"); }),
                                   hard_case("fine", [] { return measured(1); })},
                                  {});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(findings[static_cast<std::size_t>(i)].verdict, CaseVerdict::not_as_expected);
  EXPECT_NE(findings[0].reason.find("crash"), std::string::npos) << findings[0].reason;
  EXPECT_EQ(findings[1].reason, "no end within 1 s of processor time");
  EXPECT_EQ(findings[2].reason, "an exception: odd");
  EXPECT_EQ(findings[3].verdict, CaseVerdict::holds);
}

TEST(Stability, WhatIsKnownIsNotRunAgain) {
  CaseFinding known;
  known.name = "known";
  known.verdict = CaseVerdict::typed_failure;
  std::vector<std::string> told;
  StabilityOptions options;
  options.known = [&](const std::string& key) { return key == "family|a||double" ? &known : nullptr; };
  options.found = [&](const std::string& key, const CaseFinding&) { told.push_back(key); };
  const auto findings = stability({hard_case("a", of_a_crash), hard_case("b", [] { return measured(1); })}, options);
  EXPECT_EQ(findings[0].name, "known");
  EXPECT_EQ(findings[0].verdict, CaseVerdict::typed_failure);
  EXPECT_EQ(findings[1].verdict, CaseVerdict::holds);
  EXPECT_EQ(told, std::vector<std::string>{"family|b||double"});
}

/// A resumed run finds cases by their keys.
TEST(HardCases, HaveKeysOfTheirOwn) {
  for (const Collection collection : {Collection::quick, Collection::full}) {
    std::set<std::string> keys, families;
    for (const HardCase& c : hard_cases(collection)) {
      EXPECT_TRUE(keys.insert(c.key()).second) << c.key();
      EXPECT_GT(c.seconds, 0) << c.key();
      families.insert(c.family);
    }
    EXPECT_EQ(families.size(), 17u);
  }
  std::map<std::string, std::set<std::string>> precisions;
  for (const HardCase& c : hard_cases(Collection::full)) precisions[c.family].insert(c.precision);
  for (const auto& [family, seen] : precisions)
    for (const char* const precision : {"double", "quad", "mpfr:50"})
      EXPECT_TRUE(seen.contains(precision) || family == "many digits and stages") << family << " in " << precision;
}

}  // namespace
}  // namespace hbvm
