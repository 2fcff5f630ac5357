#include "method/rooted_trees.hpp"

#include <string>
#include <utility>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

/// Adds the trees that `tree` becomes by `missing` more vertices in subtrees none of which stands after `last`.
void grow(std::vector<RootedTree>& trees, RootedTree& tree, int missing, int last) {
  if (missing == 0) {
    trees.push_back(tree);
    trees.back().density *= tree.order;
    return;
  }
  for (int t = last; t >= 0; --t) {
    const auto [order, density] =
        std::pair(trees[static_cast<std::size_t>(t)].order, trees[static_cast<std::size_t>(t)].density);
    if (order > missing) continue;
    tree.subtrees.push_back(t);
    tree.density *= density;
    grow(trees, tree, missing - order, t);
    tree.density /= density;
    tree.subtrees.pop_back();
  }
}

}  // namespace

std::vector<RootedTree> rooted_trees(int max_order) {
  if (max_order < 0 || max_order > max_tree_order)
    throw InputError("trees are listed up to order " + std::to_string(max_tree_order));
  std::vector<RootedTree> trees;
  for (int order = 1; order <= max_order; ++order) {
    RootedTree root{order, 1, {}};
    grow(trees, root, order - 1, static_cast<int>(trees.size()) - 1);
  }
  return trees;
}

}  // namespace hbvm::core
