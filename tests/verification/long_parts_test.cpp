#include <gtest/gtest.h>

#include <regex>

#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

/// Whether a folder of tests/ has a test of this suite whose name begins so.
bool has_test(const std::string& folder, const std::string& suite, const std::string& begin) {
  const std::regex test(R"(\bTEST(_F|_P)?\()" + suite + R"(,\s*)" + begin);
  for (const Source& source : sources_in("tests"))
    if (source.folder == folder && std::regex_search(source.text, test)) return true;
  return false;
}

/// tests/run --thread takes its turn once in twelve days, and a filter that finds no test passes.
TEST(LongParts, TheThreadsRunTestsThatExist) {
  const std::regex line(R"(^ +\[(\w+)\]='([^']+)'$)"), filter(R"((\w+)\.(\w*))");
  int found = 0;
  for (const std::string& text : lines_in(read_file(project / "tests/run"))) {
    std::smatch entry;
    if (!std::regex_match(text, entry, line)) continue;
    const std::string folder = entry[1], filters = entry[2];
    for (std::sregex_iterator each(filters.begin(), filters.end(), filter), end; each != end; ++each, ++found) {
      EXPECT_TRUE(has_test(folder, (*each)[1], (*each)[2])) << "tests/" << folder << " has no " << each->str();
    }
  }
  EXPECT_GE(found, 10);
}

}  // namespace
}  // namespace hbvm::core
