#include "hard_cases/collection.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace hbvm::core {
namespace {

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

/// A quick look is one at the same families, and at each of them.
TEST(HardCases, OfAQuickLookAreFewer) {
  std::map<std::string, std::size_t> quick, full;
  for (const HardCase& c : hard_cases(Collection::quick)) ++quick[c.family];
  for (const HardCase& c : hard_cases(Collection::full)) ++full[c.family];
  for (const auto& [family, count] : full) {
    EXPECT_GT(quick[family], 0u) << family;
    EXPECT_LE(quick[family], count) << family;
  }
  EXPECT_EQ(quick.size(), full.size());
}

}  // namespace
}  // namespace hbvm::core
