#pragma once

#include <vector>

#include "method/rooted_trees.hpp"
#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// How far the method is from each order. Entry p - 1 is the largest |sum_i b_i Phi_i(t) - 1/gamma(t)| over the trees t
/// of order p. There Phi_i([t_1 .. t_n]) = prod_k sum_j A_ij Phi_j(t_k) (Hairer, Norsett, Wanner: Solving Ordinary
/// Differential Equations I, theorem II.2.13). These are the conditions of autonomous systems: c is not used, and
/// condition_C(method, 1) tells how far it is from the row sums of A.
/// \throws InputError unless 0 <= max_order <= max_tree_order
template <Scalar S>
std::vector<S> order_defects(const RungeKutta<S>& method, int max_order);

/// With their signs, and times gamma(t): sum_i gamma(t) b_i Phi_i(t) - 1 for each tree of order p in entry p - 1.
template <Scalar S>
std::vector<std::vector<S>> order_residuals(const RungeKutta<S>& method, int max_order);

/// The same of y' = f(t, y) for a method whose c may be other than the row sums of A. At the leaves stands
/// (1 - share) sum_j A_ij + share c_i. A method has order p if that is so for all shares.
template <Scalar S>
std::vector<std::vector<S>> order_residuals_in_time(const RungeKutta<S>& method, int max_order, const S& share);

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

/// Up to here the trees decide the order of a method; they are known up to max_tree_order.
inline constexpr int deciding_tree_order = 10;

/// The order that the conditions show when defects up to the tolerance count as 0. The trees decide it as far as
/// deciding_tree_order. A higher one follows from Butcher's theorem, as min(p, 2 q + 2, q + r + 1) for B(p), C(q) and
/// D(r).
template <Scalar S>
int order(const RungeKutta<S>& method, const S& tolerance);

}  // namespace hbvm::core
