#pragma once

#include <vector>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// A term of the derivatives of a motion q'' = f(q, q'): a derivative of f, with branches in its places.
struct NystromTree {
  enum Branch { velocity_of_start, position, velocity };
  struct Subtree {
    Branch kind;  ///< q' of the start, or a tree that the position or the velocity depends on
    int tree;     ///< its place in the list; 0 for the velocity of the start
  };
  int order = 1;     ///< of the velocity's condition; that of the position is one more
  long divisor = 1;  ///< 1/kappa, where the exact sum at the time tau is kappa tau^(order - 1)
  std::vector<Subtree> subtrees;
};

/// All trees with order 1 .. max_order; of f(q) alone, or also those in which f depends on q'.
std::vector<NystromTree> nystrom_trees(int max_order, bool with_velocity);

/// The numbers of a Nystrom method; A_hat is empty where the force does not depend on the velocity.
template <class S>
struct NystromCoefficients {
  Vector<S> c, b, b_hat;
  Matrix<S> A, A_hat;
};

/// The conditions of one order, each as a sum over its value, less 1:
///
///     sum_i b_hat_i Phi_i(t) = kappa / rho                of the trees of this order rho,
///     sum_i b_i Phi_i(t) = kappa / (rho (rho + 1))        of those one order below.
template <class S>
std::vector<S> nystrom_residuals(const NystromCoefficients<S>& method, int order) {
  std::vector<S> residuals;
  const bool with_velocity = method.A_hat.size() > 0;
  std::vector<Vector<S>> position, velocity;  // A Phi and A_hat Phi of each tree
  for (const NystromTree& tree : nystrom_trees(order, with_velocity)) {
    Vector<S> phi = Vector<S>::Ones(method.b.size());
    for (const auto& [kind, place] : tree.subtrees) {
      const auto at = static_cast<std::size_t>(place);
      const Vector<S>& branch = kind == NystromTree::velocity_of_start ? method.c
                                : kind == NystromTree::position        ? position[at]
                                                                       : velocity[at];
      for (Index i = 0; i < phi.size(); ++i) phi[i] *= branch[i];
    }
    if (tree.order == order)
      residuals.push_back(S(method.b_hat.dot(phi) * S(tree.divisor) * S(tree.order) - 1));
    else if (tree.order == order - 1)
      residuals.push_back(S(method.b.dot(phi) * S(tree.divisor) * S(tree.order) * S(tree.order + 1) - 1));
    if (tree.order == order) continue;
    position.push_back(method.A.lazyProduct(phi));
    velocity.push_back(with_velocity ? Vector<S>(method.A_hat.lazyProduct(phi)) : Vector<S>());
  }
  return residuals;
}

}  // namespace hbvm::core
