#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hbvm/linear/matrix.hpp"
#include "hbvm/scalar/expression.hpp"

namespace hbvm {

/// A Runge-Kutta method as its author writes it, as exact text: s x s, s and s entries.
struct Tableau {
  std::string name;
  std::vector<std::vector<Expression>> A;  ///< row by row
  std::vector<Expression> b, c;
  std::optional<int> order;  ///< that its author claims

  int stages() const { return static_cast<int>(b.size()); }
};

/// The same in one precision: K_i = f(t_0 + c_i h, y_0 + h sum_j A_ij K_j), y_1 = y_0 + h sum_i b_i K_i.
template <Scalar S>
struct RungeKutta {
  Matrix<S> A;
  Vector<S> b, c;

  int stages() const { return static_cast<int>(b.size()); }
};

/// Every entry is rounded once.
/// \throws InputError naming the entry, "A[2][1]" (from 1), that has no value; if A is not s x s, b and c not s long,
///         or s < 1
template <Scalar S>
RungeKutta<S> make_runge_kutta(const Tableau& tableau);

/// A rooted tree: subtrees on a root.
struct RootedTree {
  int order = 1;              ///< number of vertices
  long density = 1;           ///< gamma: the order times the densities of the subtrees
  std::vector<int> subtrees;  ///< places in the list of trees, never increasing
};

inline constexpr int max_tree_order = 10;

/// All rooted trees of orders 1 .. max_order, in this sequence: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719 of each order.
/// \throws InputError unless 0 <= max_order <= max_tree_order
std::vector<RootedTree> rooted_trees(int max_order);

/// How far the method is from each order: entry p - 1 is the largest |sum_i b_i Phi_i(t) - 1/gamma(t)| over the trees
/// t of order p, where Phi_i([t_1 .. t_n]) = prod_k sum_j A_ij Phi_j(t_k) (Hairer, Norsett, Wanner: Solving Ordinary
/// Differential Equations I, theorem II.2.13). These are the conditions of autonomous systems: c is not used, and
/// condition_C(method, 1) tells how far it is from the row sums of A.
/// \throws InputError unless 0 <= max_order <= max_tree_order
template <Scalar S>
std::vector<S> order_defects(const RungeKutta<S>& method, int max_order);

/// The largest defects of Butcher's simplifying assumptions (the same, section IV.5 of volume II); 0 if p, q or r is:
///
///     B(p): sum_i b_i c_i^(n-1) = 1/n,                        n <= p
///     C(q): sum_j A_ij c_j^(n-1) = c_i^n / n,                 n <= q, all i
///     D(r): sum_i b_i c_i^(n-1) A_ij = b_j (1 - c_j^n) / n,   n <= r, all j
template <Scalar S>
S condition_B(const RungeKutta<S>& method, int p);
template <Scalar S>
S condition_C(const RungeKutta<S>& method, int q);
template <Scalar S>
S condition_D(const RungeKutta<S>& method, int r);

/// The largest of |A_{s+1-i,s+1-j} + A_ij - b_j| and |b_{s+1-i} - b_i|: 0 for a method that is its own adjoint, if its
/// stages stand in the order that the adjoint reverses (Hairer, Lubich, Wanner: Geometric Numerical Integration,
/// theorem V.2.3).
template <Scalar S>
S symmetry_defect(const RungeKutta<S>& method);

/// The largest |b_i A_ij + b_j A_ji - b_i b_j|: 0 for a method that conserves quadratic invariants, and so is
/// symplectic (the same, theorems IV.2.2 and VI.4.3).
template <Scalar S>
S symplecticity_defect(const RungeKutta<S>& method);

/// The order that the conditions show when defects up to the tolerance count as 0: by the trees as far as
/// max_tree_order; a higher one by Butcher's theorem, as min(p, 2 q + 2, q + r + 1) for B(p), C(q) and D(r).
template <Scalar S>
int order(const RungeKutta<S>& method, const S& tolerance);

#define HBVM_DECLARE(S)                                                       \
  extern template RungeKutta<S> make_runge_kutta<S>(const Tableau&);          \
  extern template std::vector<S> order_defects<S>(const RungeKutta<S>&, int); \
  extern template S condition_B<S>(const RungeKutta<S>&, int);                \
  extern template S condition_C<S>(const RungeKutta<S>&, int);                \
  extern template S condition_D<S>(const RungeKutta<S>&, int);                \
  extern template S symmetry_defect<S>(const RungeKutta<S>&);                 \
  extern template S symplecticity_defect<S>(const RungeKutta<S>&);            \
  extern template int order<S>(const RungeKutta<S>&, const S&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
