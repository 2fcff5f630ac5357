#include "linear/ordering.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hbvm::core {
namespace {

void expect_permutation(const Ordering& order) {
  std::vector<Index> sorted = order.position;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], static_cast<Index>(i));
}

TEST(Ordering, StraightensAShuffledChain) {
  std::vector<std::pair<Index, Index>> links;
  for (Index i = 0; i + 1 < 50; ++i) links.emplace_back((7 * i) % 50, (7 * (i + 1)) % 50);
  const Ordering order = order_for_band(50, links);
  expect_permutation(order);
  EXPECT_EQ(order.half_bandwidth, 1);
}

TEST(Ordering, ClosesARingWithTwo) {
  std::vector<std::pair<Index, Index>> links;
  for (Index i = 0; i < 30; ++i) links.emplace_back(i, (i + 1) % 30);
  EXPECT_EQ(order_for_band(30, links).half_bandwidth, 2);
}

TEST(Ordering, LeavesWhatIsNoWorseAsItIs) {
  std::vector<std::pair<Index, Index>> all;
  for (Index i = 0; i < 5; ++i)
    for (Index j = 0; j < 5; ++j) all.emplace_back(i, j);
  const Ordering order = order_for_band(5, all);
  EXPECT_EQ(order.position, (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_EQ(order.half_bandwidth, 4);
}

TEST(Ordering, TakesPartsAndNothing) {
  expect_permutation(order_for_band(6, {{0, 5}, {1, 4}}));
  EXPECT_EQ(order_for_band(6, {{0, 5}, {1, 4}}).half_bandwidth, 1);
  EXPECT_EQ(order_for_band(3, {{0, 0}, {1, 1}}).half_bandwidth, 0);
  EXPECT_TRUE(order_for_band(0, {}).position.empty());
}

}  // namespace
}  // namespace hbvm::core
