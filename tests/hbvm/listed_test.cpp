#include "listed.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

/// All of them, or the first eight and how many there are besides: never "and 1 more".
TEST(Listed, EndsALongList) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  std::vector<std::string> names(9, "x");
  EXPECT_EQ(listed(names), "x, x, x, x, x, x, x, x, x");
  names.emplace_back("y");
  EXPECT_EQ(listed(names), "x, x, x, x, x, x, x, x, and 2 more");
}

}  // namespace
}  // namespace hbvm::core
