#include <gtest/gtest.h>

#include <map>
#include <set>

#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

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

/// The commands are tested as a user has them, and the families of hard cases are cases themselves.
bool is_tested_by_running(const std::string& folder) { return folder == "cli" || folder == "hard_cases/family"; }

struct Place {
  std::string folder, name;
  std::string path() const { return folder.empty() ? name : folder + "/" + name; }
};

/// All files below a folder of the project whose names end so, without that ending.
std::vector<Place> files(const char* root, const std::string& ending) {
  namespace fs = std::filesystem;
  const fs::path base = project / root;
  std::vector<Place> result;
  for (const auto& entry : fs::recursive_directory_iterator(base)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(ending)) continue;
    result.push_back(
        {fs::relative(entry.path().parent_path(), base).generic_string(), name.substr(0, name.size() - ending.size())});
    if (result.back().folder == ".") result.back().folder.clear();
  }
  return result;
}

/// tests/X/Z/Y_test.cpp or tests/X/Y_test.cpp for src/X/Z/Y.cpp; tests/hbvm/Y_test.cpp for src/Y.cpp.
bool is_of(const Place& test, const Place& source) {
  if (test.name != source.name) return false;
  if (source.folder.empty()) return test.folder == "hbvm";
  if (source.folder == "run") return test.folder == "runs";  // tests/run is the script
  return (source.folder + "/").starts_with(test.folder + "/");
}

TEST(Sources, HaveTestsOfTheirName) {
  const std::vector<Place> tests = files("tests", "_test.cpp");
  std::set<std::string> unused;
  for (const auto& [path, reason] : exceptions()) unused.insert(path);
  std::size_t seen = 0;
  for (const Place& source : files("src", ".cpp")) {
    if (is_tested_by_running(source.folder)) continue;
    ++seen;
    const bool tested = std::any_of(tests.begin(), tests.end(), [&](const Place& test) { return is_of(test, source); });
    const bool excepted = unused.erase(source.path()) > 0;
    EXPECT_TRUE(tested || excepted) << "src/" << source.path() << ".cpp has no test of its name";
    EXPECT_FALSE(tested && excepted) << "src/" << source.path() << ".cpp has a test: it is no exception";
  }
  EXPECT_GT(seen, 80u);
  for (const std::string& path : unused) ADD_FAILURE() << "src/" << path << ".cpp is an exception, but not there";
}

}  // namespace
}  // namespace hbvm::core
