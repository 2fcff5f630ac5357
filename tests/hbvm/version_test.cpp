#include "hbvm/version.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "read_file.hpp"

namespace hbvm::core {
namespace {

TEST(Version, IsThreeNumbersAndTheCommitIfItIsKnown) {
  EXPECT_TRUE(std::regex_match(version(), std::regex(R"(\d+\.\d+\.\d+(\+g[0-9a-f]{7,40}(\.modified)?)?)")))
      << version();
}

/// The file that says how to cite it names the same.
TEST(Version, IsThatOfTheCitation) {
  const std::string number = std::string(version()).substr(0, std::string(version()).find('+'));
  EXPECT_NE(read_file(std::string(HBVM_SOURCE_DIR) + "/src/install/CITATION.cff").find("\nversion: " + number + "\n"),
            std::string::npos)
      << number;
}

}  // namespace
}  // namespace hbvm::core
