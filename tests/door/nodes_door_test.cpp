#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/nodes.hpp"

namespace hbvm {
namespace {

/// (1 -+ 1/sqrt 3) / 2.
TEST(DoorNodes, OfTwoAreKnown) {
  const Nodes two = nodes(2, "mpfr:40");
  EXPECT_EQ(two.c[0].substr(0, 40), "0.21132486540518711774542560974902127217");
  EXPECT_EQ(two.b, (std::vector<std::string>{"0.5", "0.5"}));
  EXPECT_EQ(nlohmann::json::parse(to_json(two)).at("c"), two.c);
  EXPECT_THROW(nodes(0), InputError);
}

}  // namespace
}  // namespace hbvm
