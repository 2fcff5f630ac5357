#include <gtest/gtest.h>

#include "audit/claim_groups.hpp"
#include "audit/measurements.hpp"

namespace hbvm::core {
namespace {

constexpr auto to_the_end = [](const Ladders&) { return false; };

TEST(IntervalLadder, HasTheRatesOfAConstrainedMotion) {
  ClaimGroup group =
      group_of("double_pendulum", {2, 2}, {Quantity::q, Quantity::tangential_p, Quantity::hidden, Quantity::H});
  group.log2_scale = -2;
  const Ladders ladders = interval_ladder<Quad>(group, 128, to_the_end);
  EXPECT_TRUE(is_rate(ladders.at(Quantity::q), 4));
  EXPECT_TRUE(is_rate(ladders.at(Quantity::tangential_p), 4));
  EXPECT_TRUE(is_rate(ladders.at(Quantity::hidden), 2));
}

TEST(IntervalLadder, DividesTheIntervalUntilItIsEnough) {
  ClaimGroup group = group_of("kepler", {2, 2}, {Quantity::H});
  group.log2_scale = 1;
  group.log2_interval = -3;
  const auto rungs = interval_ladder<double>(group, 1024, [](const Ladders& l) {
                       return l.at(Quantity::H).size() == 3;
                     }).at(Quantity::H);
  ASSERT_EQ(rungs.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(rungs[static_cast<std::size_t>(i)].step, -2 - (2 + i));
  EXPECT_EQ(interval_ladder<double>(group, 8, to_the_end).at(Quantity::H).size(), 2u);
}

/// More windows are more steps of the same size, and so a greater error in the end.
TEST(IntervalLadder, GoesThroughAllWindows) {
  ClaimGroup group = group_of("kepler", {1, 1}, {Quantity::q});
  const Rung one = interval_ladder<double>(group, 4, to_the_end).at(Quantity::q).front();
  group.windows = 2;
  const Rung two = interval_ladder<double>(group, 4, to_the_end).at(Quantity::q).front();
  group.windows = 1;
  group.log2_interval = 0;
  const Rung twice = interval_ladder<double>(group, 8, to_the_end).at(Quantity::q).back();
  EXPECT_EQ(one.step, two.step);
  EXPECT_GT(two.error, one.error);
  EXPECT_NEAR(two.error, twice.error, 1 / double{1'000'000});
}

}  // namespace
}  // namespace hbvm::core
