#include "hbvm/version.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace hbvm {
namespace {

TEST(Version, IsThreeNumbersAndTheCommitIfItIsKnown) {
  EXPECT_TRUE(std::regex_match(version(), std::regex(R"(\d+\.\d+\.\d+(\+g[0-9a-f]{7,40}(\.modified)?)?)")))
      << version();
}

}  // namespace
}  // namespace hbvm
