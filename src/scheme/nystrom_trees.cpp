#include "scheme/nystrom_trees.hpp"

namespace hbvm::core {
namespace {

/// What can be a branch: its size in a tree, and by how much it divides kappa.
struct Item {
  NystromTree::Subtree subtree;
  int size;
  long divisor;
};

void grow(std::vector<NystromTree>& trees, const std::vector<Item>& items, NystromTree& tree, int missing,
          std::size_t last) {
  if (missing == 0) {
    trees.push_back(tree);
    return;
  }
  for (std::size_t n = last + 1; n-- > 0;) {
    const Item& item = items[n];
    if (item.size > missing) continue;
    tree.subtrees.push_back(item.subtree);
    tree.divisor *= item.divisor;
    grow(trees, items, tree, missing - item.size, n);
    tree.divisor /= item.divisor;
    tree.subtrees.pop_back();
  }
}

}  // namespace

std::vector<NystromTree> nystrom_trees(int max_order, bool with_velocity) {
  std::vector<NystromTree> trees;
  // q' of the start contributes tau. A tree of order rho contributes tau^(rho + 1) / (rho (rho + 1)) to the position,
  // and tau^rho / rho to the velocity. Each of these is multiplied by the tree's own kappa.
  std::vector<Item> items{{{NystromTree::velocity_of_start, 0}, 1, 1}};
  for (int order = 1; order <= max_order; ++order) {
    const std::size_t before = trees.size();
    NystromTree root;
    root.order = order;
    grow(trees, items, root, order - 1, items.size() - 1);
    for (std::size_t t = before; t < trees.size(); ++t) {
      const int place = static_cast<int>(t);
      items.push_back({{NystromTree::position, place}, order + 1, trees[t].divisor * order * (order + 1)});
      if (with_velocity) items.push_back({{NystromTree::velocity, place}, order, trees[t].divisor * order});
    }
  }
  return trees;
}

}  // namespace hbvm::core
