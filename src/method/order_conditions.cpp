#include "method/order_conditions.hpp"

#include <algorithm>

#include "linear/product.hpp"

namespace hbvm::core {
namespace {

/// Calls use(tree, residual) for tree after tree, as long as it returns true. \param leaf instead of the row sums of A
template <Scalar S, class Use>
void for_each_condition(const RungeKutta<S>& method, int max_order, const Use& use, const Vector<S>* leaf = nullptr) {
  const Index s = method.b.size();
  std::vector<Vector<S>> A_phi;  // A Phi(t) for each tree that can be a subtree
  Vector<S> phi(s);
  for (const RootedTree& tree : rooted_trees(max_order)) {
    for (Index i = 0; i < s; ++i) {
      phi[i] = 1;
      for (const int t : tree.subtrees) phi[i] *= A_phi[static_cast<std::size_t>(t)][i];
    }
    if (!use(tree, S(dot(method.b, phi) - S(1) / S(tree.density)))) return;
    if (tree.order < max_order) A_phi.push_back(method.A.lazyProduct(phi));
    if (tree.order == 1 && leaf && !A_phi.empty()) A_phi.back() = *leaf;
  }
}

/// The defects of B, C and D for one power n, from c_i^(n-1).
template <Scalar S>
S defect_B(const RungeKutta<S>& method, int n, const Vector<S>& before) {
  return magnitude(S(dot(method.b, before) - S(1) / S(n)));
}

template <Scalar S>
S defect_C(const RungeKutta<S>& method, int n, const Vector<S>& before) {
  const Vector<S> sums = method.A.lazyProduct(before);
  S worst = 0;
  for (Index i = 0; i < sums.size(); ++i) raise_to(worst, magnitude(S(sums[i] - before[i] * method.c[i] / S(n))));
  return worst;
}

template <Scalar S>
S defect_D(const RungeKutta<S>& method, int n, const Vector<S>& before) {
  S worst = 0;
  for (Index j = 0; j < method.b.size(); ++j) {
    S sum = 0;
    for (Index i = 0; i < method.b.size(); ++i) sum += method.b[i] * before[i] * method.A(i, j);
    raise_to(worst, magnitude(S(sum - method.b[j] * (1 - before[j] * method.c[j]) / S(n))));
  }
  return worst;
}

template <Scalar S>
using Defect = S (*)(const RungeKutta<S>&, int, const Vector<S>&);

/// Calls use(defect) for the powers 1, 2, ... most, as long as it returns true.
template <Scalar S, class Use>
void for_each_power(Defect<S> defect, const RungeKutta<S>& method, int most, const Use& use) {
  Vector<S> power = Vector<S>::Ones(method.c.size());
  for (int n = 1; n <= most; ++n) {
    if (!use(defect(method, n, power))) return;
    for (Index i = 0; i < power.size(); ++i) power[i] *= method.c[i];
  }
}

template <Scalar S>
S worst_of(Defect<S> defect, const RungeKutta<S>& method, int last) {
  S worst = 0;
  for_each_power(defect, method, last, [&](const S& own) {
    raise_to(worst, own);
    return true;
  });
  return worst;
}

/// How many powers in a row, at most `most`, have a defect up to the tolerance.
template <Scalar S>
int fulfilled(Defect<S> defect, const RungeKutta<S>& method, const S& tolerance, int most) {
  int n = 0;
  for_each_power(defect, method, most, [&](const S& own) { return own <= tolerance && ++n > 0; });
  return n;
}

}  // namespace

template <Scalar S>
std::vector<S> order_defects(const RungeKutta<S>& method, int max_order) {
  std::vector<S> worst(static_cast<std::size_t>(std::max(max_order, 0)), S(0));
  for_each_condition(method, max_order, [&](const RootedTree& tree, const S& residual) {
    raise_to(worst[static_cast<std::size_t>(tree.order - 1)], magnitude(residual));
    return true;
  });
  return worst;
}

template <Scalar S>
std::vector<std::vector<S>> order_residuals(const RungeKutta<S>& method, int max_order) {
  std::vector<std::vector<S>> residuals(static_cast<std::size_t>(std::max(max_order, 0)));
  for_each_condition(method, max_order, [&](const RootedTree& tree, const S& residual) {
    residuals[static_cast<std::size_t>(tree.order - 1)].push_back(S(residual * S(tree.density)));
    return true;
  });
  return residuals;
}

template <Scalar S>
std::vector<std::vector<S>> order_residuals_in_time(const RungeKutta<S>& method, int max_order, const S& share) {
  std::vector<std::vector<S>> residuals(static_cast<std::size_t>(std::max(max_order, 0)));
  const Vector<S> sums = method.A.lazyProduct(Vector<S>(Vector<S>::Ones(method.b.size())));
  const Vector<S> leaf = sums + share * (method.c - sums);
  for_each_condition(
      method, max_order,
      [&](const RootedTree& tree, const S& residual) {
        residuals[static_cast<std::size_t>(tree.order - 1)].push_back(S(residual * S(tree.density)));
        return true;
      },
      &leaf);
  return residuals;
}

template <Scalar S>
S condition_B(const RungeKutta<S>& method, int p) {
  return worst_of<S>(defect_B<S>, method, p);
}

template <Scalar S>
S condition_C(const RungeKutta<S>& method, int q) {
  return worst_of<S>(defect_C<S>, method, q);
}

template <Scalar S>
S condition_D(const RungeKutta<S>& method, int r) {
  return worst_of<S>(defect_D<S>, method, r);
}

template <Scalar S>
int order(const RungeKutta<S>& method, const S& tolerance) {
  // No method of s stages has an order above 2 s.
  const int s = method.stages(), by_trees = std::min(deciding_tree_order, 2 * s);
  int p = by_trees;
  for_each_condition(method, by_trees, [&](const RootedTree& tree, const S& residual) {
    if (magnitude(residual) <= tolerance) return true;
    p = tree.order - 1;
    return false;
  });
  if (p < deciding_tree_order) return p;
  const int B = fulfilled<S>(defect_B<S>, method, tolerance, 2 * s);
  const int C = fulfilled<S>(defect_C<S>, method, tolerance, s);
  const int D = fulfilled<S>(defect_D<S>, method, tolerance, s);
  return std::max(p, std::min({B, 2 * C + 2, C + D + 1}));
}

#define HBVM_DEFINE(S)                                                                                  \
  template std::vector<S> order_defects<S>(const RungeKutta<S>&, int);                                  \
  template std::vector<std::vector<S>> order_residuals<S>(const RungeKutta<S>&, int);                   \
  template std::vector<std::vector<S>> order_residuals_in_time<S>(const RungeKutta<S>&, int, const S&); \
  template S condition_B<S>(const RungeKutta<S>&, int);                                                 \
  template S condition_C<S>(const RungeKutta<S>&, int);                                                 \
  template S condition_D<S>(const RungeKutta<S>&, int);                                                 \
  template int order<S>(const RungeKutta<S>&, const S&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
