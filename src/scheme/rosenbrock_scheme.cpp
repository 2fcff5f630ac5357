#include "method/rooted_trees.hpp"
#include "scheme/families.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_rosenbrock = 8;

/// k_i = h f(y + sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j and y_1 = y + sum_i b_i k_i. J is the Jacobian at y, and
/// gamma holds its diagonal. Conditions: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, section
/// IV.7: below a vertex with one branch stands alpha + gamma, below one with more alpha.
class RosenbrockScheme final : public SchemeByTemplate<RosenbrockScheme> {
 public:
  explicit RosenbrockScheme(const SchemeText& text) {
    const std::size_t s = row_length(text, "b");
    take(text, "alpha", s, s);
    take(text, "gamma", s, s);
    take(text, "b", 1, s);
    add_part(text, "order", "order", highest_of_rosenbrock);
    if (text.arrays.contains("b_hat")) {
      take(text, "b_hat", 1, s);
      add_part(text, "embedded order", "embedded_order", highest_of_rosenbrock);
    }
  }

  std::string family() const override { return "rosenbrock"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t part, int order, const std::vector<S>& values) const {
    const Matrix<S> alpha = matrix("alpha", values), both = alpha + matrix("gamma", values);
    const Vector<S> b = vector(part == 0 ? "b" : "b_hat", values);
    std::vector<S> residuals;
    std::vector<Vector<S>> among, alone;  // alpha Phi and (alpha + gamma) Phi of each tree
    for (const RootedTree& tree : rooted_trees(order)) {
      Vector<S> phi = Vector<S>::Ones(b.size());
      for (const int t : tree.subtrees) {
        const auto& below = tree.subtrees.size() == 1 ? alone : among;
        for (Index i = 0; i < phi.size(); ++i) phi[i] *= below[static_cast<std::size_t>(t)][i];
      }
      if (tree.order == order) {
        residuals.push_back(S(b.dot(phi) * S(tree.density) - 1));
        continue;
      }
      among.push_back(alpha.lazyProduct(phi));
      alone.push_back(both.lazyProduct(phi));
    }
    return residuals;
  }
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>&) const {
    return {};
  }
};

}  // namespace

SchemePtr rosenbrock_scheme(const SchemeText& text) { return std::make_shared<const RosenbrockScheme>(text); }

}  // namespace hbvm::core
