#pragma once

#include <cstddef>
#include <vector>

namespace hbvm::core {

/// A rooted tree: subtrees on a root.
struct RootedTree {
  int order = 1;              ///< number of vertices
  long density = 1;           ///< gamma: the order times the densities of the subtrees
  std::vector<int> subtrees;  ///< places in the list of trees, never increasing
};

inline constexpr int max_tree_order = 12;

/// Adds the trees that `tree` becomes by `missing` more vertices in subtrees none of which stands after `last`. Tree
/// has what a RootedTree has.
template <class Tree>
void grow(std::vector<Tree>& trees, Tree& tree, int missing, int last) {
  if (missing == 0) {
    trees.push_back(tree);
    trees.back().density *= tree.order;
    return;
  }
  for (int t = last; t >= 0; --t) {
    const int order = trees[static_cast<std::size_t>(t)].order;
    const long density = trees[static_cast<std::size_t>(t)].density;
    if (order > missing) continue;
    tree.subtrees.push_back(t);
    tree.density *= density;
    grow(trees, tree, missing - order, t);
    tree.density /= density;
    tree.subtrees.pop_back();
  }
}

/// All rooted trees of orders 1 .. max_order, in this sequence: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766 of
/// each order. \throws InputError unless 0 <= max_order <= max_tree_order
std::vector<RootedTree> rooted_trees(int max_order);

}  // namespace hbvm::core
