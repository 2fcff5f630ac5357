#include "method/rooted_trees.hpp"

#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

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
