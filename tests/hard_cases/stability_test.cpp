#include "hard_cases/stability.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include "hard_cases/measured.hpp"
#include "hard_cases/report.hpp"

namespace hbvm::core {
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

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
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
  CellStore store;
  store.add("quick|family|a||double", to_result(judge(hard_case("a", of_a_crash), measured(3))));
  StabilityOptions options;
  options.store = &store;
  const std::vector<HardCase> cases{hard_case("a", of_a_crash), hard_case("b", [] { return measured(1); })};
  const auto findings = stability(cases, options);
  EXPECT_EQ(findings[0].deciding()->value, 3);
  EXPECT_FALSE(findings[0].cpu_seconds) << "it took none";
  EXPECT_EQ(findings[1].verdict, CaseVerdict::holds);
  EXPECT_TRUE(findings[1].cpu_seconds);
  EXPECT_EQ(read_case_result(*store.find("quick|family|b||double")).deciding()->value, 1);
  options.collection = Collection::full;
  EXPECT_EQ(stability(cases, options)[0].reason.find("a crash"), 0u) << "of another collection";
}

/// In shards, by any number of processes, with a store that was cut off anywhere.
TEST(Stability, EndsInTheSameFileHoweverItIsDivided) {
  std::string folder = (std::filesystem::temp_directory_path() / "hbvm_stability_test_XXXXXX").string();
  ASSERT_TRUE(mkdtemp(folder.data()));
  const auto path = [&](const std::string& name) { return folder + "/" + name; };
  std::vector<HardCase> cases;
  for (int i = 0; i < 9; ++i) cases.push_back(hard_case(std::to_string(i), [i] { return measured(i / double{3}); }));
  cases.push_back(hard_case("crash", of_a_crash));
  const auto run = [&](const std::string& name, int jobs, const Shard& shard) {
    CellStore store(path(name));
    StabilityOptions options;
    options.jobs = jobs;
    options.shard = shard;
    options.store = &store;
    return stability(cases, options);
  };
  run("one", 1, {});
  const std::string whole = text_of(path("one"));
  CellStore merged(path("merged"));
  for (const int i : {2, 3, 1}) {
    const std::string name = "shard" + std::to_string(i);
    EXPECT_EQ(run(name, i, {i, 3}).size(), i == 1 ? 4u : 3u);
    merged.merge(path(name));
  }
  StabilityOptions options;
  options.store = &merged;
  options.progress = [](long done, long total) { EXPECT_EQ(done, total) << "nothing is left to do"; };
  EXPECT_EQ(stability(cases, options).size(), cases.size());
  EXPECT_EQ(text_of(path("merged")), whole);
  std::mt19937 random(11);
  for (int n = 0; n < 20; ++n) {
    const std::size_t length = random() % (whole.size() + 1);
    std::ofstream(path("cut"), std::ios::binary | std::ios::trunc) << whole.substr(0, length);
    run("cut", 3, {});
    EXPECT_EQ(text_of(path("cut")), whole) << length;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace hbvm::core
