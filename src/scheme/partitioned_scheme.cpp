#include "method/rooted_trees.hpp"
#include "scheme/families.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_partitioned = 12, highest_coupled = 6;

/// A rooted tree whose vertices are of the first or the second equation.
struct ColouredTree : RootedTree {
  bool second = false;  ///< the colour of its root
};

std::vector<ColouredTree> coloured_trees(int order) {
  std::vector<ColouredTree> trees;
  for (int n = 1; n <= order; ++n) {
    const int last = static_cast<int>(trees.size()) - 1;
    for (const bool second : {false, true}) {
      ColouredTree root{{n, 1, {}}, second};
      grow(trees, root, n - 1, last);
    }
  }
  return trees;
}

/// y' = f(y, z) by (A, b) and z' = g(y, z) by (A_hat, b_hat).
class PartitionedScheme final : public SchemeByTemplate<PartitionedScheme> {
 public:
  explicit PartitionedScheme(const SchemeText& text) {
    const std::size_t s = row_length(text, "b");
    take(text, "A", s, s);
    take(text, "b", 1, s);
    take(text, "A_hat", s, s);
    take(text, "b_hat", 1, s);
    add_part(text, "order of y' = f(z), z' = g(y)", "order", highest_of_partitioned);
    add_part(text, "order of y' = f(y, z), z' = g(y, z)", "coupled_order", highest_coupled);
  }

  std::string family() const override { return "partitioned"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t part, int order, const std::vector<S>& values) const {
    const Matrix<S> A[2] = {matrix("A", values), matrix("A_hat", values)};
    const Vector<S> b[2] = {vector("b", values), vector("b_hat", values)};
    return part == 0 ? separate(A, b, order) : coupled(A, b, order);
  }
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>&) const {
    return {};
  }

 private:
  /// The colours of the vertices alternate.
  template <class S>
  static std::vector<S> separate(const Matrix<S> (&A)[2], const Vector<S> (&b)[2], int order) {
    std::vector<S> residuals;
    std::vector<Vector<S>> below[2];  // A Phi of each tree by the colour of its root
    for (const RootedTree& tree : rooted_trees(order))
      for (const int colour : {0, 1}) {
        Vector<S> phi = Vector<S>::Ones(b[0].size());
        for (const int t : tree.subtrees)
          for (Index i = 0; i < phi.size(); ++i) phi[i] *= below[1 - colour][static_cast<std::size_t>(t)][i];
        if (tree.order == order)
          residuals.push_back(S(b[colour].dot(phi) * S(tree.density) - 1));
        else
          below[colour].push_back(A[colour].lazyProduct(phi));
      }
    return residuals;
  }

  template <class S>
  static std::vector<S> coupled(const Matrix<S> (&A)[2], const Vector<S> (&b)[2], int order) {
    std::vector<S> residuals;
    std::vector<Vector<S>> below;
    for (const ColouredTree& tree : coloured_trees(order)) {
      const int colour = tree.second ? 1 : 0;
      Vector<S> phi = Vector<S>::Ones(b[0].size());
      for (const int t : tree.subtrees)
        for (Index i = 0; i < phi.size(); ++i) phi[i] *= below[static_cast<std::size_t>(t)][i];
      if (tree.order == order)
        residuals.push_back(S(b[colour].dot(phi) * S(tree.density) - 1));
      else
        below.push_back(A[colour].lazyProduct(phi));
    }
    return residuals;
  }
};

}  // namespace

SchemePtr partitioned_scheme(const SchemeText& text) { return std::make_shared<const PartitionedScheme>(text); }

}  // namespace hbvm::core
