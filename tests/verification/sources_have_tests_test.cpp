#include <gtest/gtest.h>

#include <map>
#include <set>

#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// Sources, by their path in src without the ending, whose tests have another name, and why.
const std::map<std::string, std::string>& exceptions() {
  static const std::map<std::string, std::string> reasons{
      {"audit/audit_figure",
       "thousands of steps with 50 digits, ten times over; interval_ladder_test holds its errors"},
      {"audit/sensitivity", "the floors it gives decide auditor_test, round_off_test and both ladders' tests"},
      {"hard_cases/figures", "runs of 2^20 steps; measure_test and round_off_growth_test hold what it shows"},
      {"study/conservation_study", "a kind of study: study_test runs one with right and wrong figures"},
      {"study/halving_study", "likewise"},
      {"study/long_run_study", "likewise"},
      {"study/study_figure", "study_test looks at the files it writes"},
      {"problem/effect/cpp_text", "of the generator: what it prints is compiled, and kernel_test runs it"},
      {"problem/effect/generate/effect_kernels", "the generator's main program"}};
  return reasons;
}

/// The commands and the Python module are tested as a user has them. The families of hard cases are cases themselves.
bool is_tested_by_running(const std::string& folder) {
  return folder == "cli" || folder == "hard_cases/family" || folder == "python/module";
}

/// The files below a folder of the project whose names end so: their paths there, without that ending.
std::vector<fs::path> files(const char* root, const std::string& ending) {
  std::vector<fs::path> result;
  for (const Source& source : sources_in(root)) {
    const std::string path = source.path.lexically_relative(project / root).generic_string();
    if (path.ends_with(ending)) result.emplace_back(path.substr(0, path.size() - ending.size()));
  }
  return result;
}

/// tests/X/Z/Y_test.cpp or tests/X/Y_test.cpp for src/X/Z/Y.cpp; tests/hbvm/Y_test.cpp for src/Y.cpp.
bool is_of(const fs::path& test, const fs::path& source) {
  if (test.filename() != source.filename()) return false;
  const std::string of_test = test.parent_path().generic_string();
  std::string folder = source.parent_path().generic_string();
  if (folder.empty()) return of_test == "hbvm";
  if ((folder + "/").starts_with("run/")) folder.insert(3, "s");  // tests/run is the script
  return (folder + "/").starts_with(of_test + "/");
}

TEST(Sources, HaveTestsOfTheirName) {
  const std::vector<fs::path> tests = files("tests", "_test.cpp");
  std::set<std::string> unused;
  for (const auto& [path, reason] : exceptions()) unused.insert(path);
  std::size_t seen = 0;
  for (const fs::path& source : files("src", ".cpp")) {
    const std::string path = source.generic_string();
    if (is_tested_by_running(source.parent_path().generic_string())) continue;
    ++seen;
    const bool tested =
        std::any_of(tests.begin(), tests.end(), [&](const fs::path& test) { return is_of(test, source); });
    const bool excepted = unused.erase(path) > 0;
    EXPECT_TRUE(tested || excepted) << "src/" << path << ".cpp has no test of its name";
    EXPECT_FALSE(tested && excepted) << "src/" << path << ".cpp has a test: it is no exception";
  }
  EXPECT_GT(seen, 80u);
  for (const std::string& path : unused) ADD_FAILURE() << "src/" << path << ".cpp is an exception, but not there";
}

}  // namespace
}  // namespace hbvm::core
