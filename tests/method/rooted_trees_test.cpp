#include "method/rooted_trees.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hbvm::core {
namespace {

TEST(RootedTrees, AreAllThereOnce) {
  const std::vector<RootedTree> trees = rooted_trees(max_tree_order);
  std::vector<int> counts(max_tree_order, 0);
  std::set<std::vector<int>> seen;
  for (const RootedTree& tree : trees) {
    ++counts[static_cast<std::size_t>(tree.order - 1)];
    EXPECT_TRUE(seen.insert(tree.subtrees).second);
    EXPECT_TRUE(std::is_sorted(tree.subtrees.rbegin(), tree.subtrees.rend()));
    int order = 1;
    long density = 1;
    for (const int t : tree.subtrees) {
      order += trees[static_cast<std::size_t>(t)].order;
      density *= trees[static_cast<std::size_t>(t)].density;
    }
    EXPECT_EQ(tree.order, order);
    EXPECT_EQ(tree.density, density * order);
  }
  EXPECT_EQ(counts, (std::vector<int>{1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766}));
  EXPECT_EQ(trees.size(), 7813u);
  long factorial = 1;
  for (int n = 1; n <= max_tree_order; ++n) factorial *= n;
  long highest = 0;
  for (const RootedTree& tree : trees) highest = std::max(highest, tree.density);
  EXPECT_EQ(highest, factorial) << "the tree without branches";
}

}  // namespace
}  // namespace hbvm::core
