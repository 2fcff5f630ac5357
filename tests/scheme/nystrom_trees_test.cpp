#include "scheme/nystrom_trees.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

std::vector<long> counts(bool with_velocity, int orders) {
  std::vector<long> counts(static_cast<std::size_t>(orders), 0);
  for (const NystromTree& tree : nystrom_trees(orders, with_velocity))
    ++counts[static_cast<std::size_t>(tree.order - 1)];
  return counts;
}

/// Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, table II.14.1 and its neighbour: the conditions
/// of the velocity.
TEST(NystromTrees, AreAsMany) {
  EXPECT_EQ(counts(false, 8), (std::vector<long>{1, 1, 2, 3, 6, 10, 20, 36}));
  // f; f_q v, f_v f; f_qq vv, f_qv vf, f_vv ff, f_q f, f_v f_q v, f_v f_v f.
  EXPECT_EQ(counts(true, 3), (std::vector<long>{1, 2, 6}));
}

}  // namespace
}  // namespace hbvm::core
