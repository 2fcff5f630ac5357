#pragma once

#include <vector>

namespace hbvm::core {

/// A rooted tree: subtrees on a root.
struct RootedTree {
  int order = 1;              ///< number of vertices
  long density = 1;           ///< gamma: the order times the densities of the subtrees
  std::vector<int> subtrees;  ///< places in the list of trees, never increasing
};

inline constexpr int max_tree_order = 12;

/// All rooted trees of orders 1 .. max_order, in this sequence: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766 of
/// each order. \throws InputError unless 0 <= max_order <= max_tree_order
std::vector<RootedTree> rooted_trees(int max_order);

}  // namespace hbvm::core
