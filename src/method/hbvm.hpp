#pragma once

#include "linear/matrix.hpp"
#include "method/hbvm_name.hpp"

namespace hbvm::core {

/// The coefficients of HBVM(k, s), k >= s >= 1: all a step needs and no more. They do not depend on the step.
/// Names are the paper's: P_s, I_s (27), X_s (32), and P_hat of the k nodes (53). k = s is the s-stage Gauss method.
///
/// With r = s nodes for the constraints, the paper's method, the multipliers are unknown, and the hidden constraints
/// imposed, at these nodes. With r > s, for constraints that are not quadratic, the multiplier is a polynomial,
/// lambda(c) = sum_l P_l(c) lambda_l, with s coefficients. So many Legendre coefficients of the hidden constraint
/// vanish: the coefficient of P_0 is what keeps g. For r = s that says the same.
template <Scalar S>
struct Hbvm {
  int k = 0, s = 0, r = 0;
  Vector<S> c, b;            ///< the r nodes and weights of the constraints
  Vector<S> c_hat, b_hat;    ///< the k nodes and weights of psi_hat (50)
  Matrix<S> P_s, I_s;        ///< r x s: P_j(c_i) and int_0^{c_i} P_j
  Matrix<S> P_hat, I_hat;    ///< k x s: the same at c_hat
  Matrix<S> X_s;             ///< s x s, tridiagonal: I_s = P_s X_s for r = s (31)
  Matrix<S> projection;      ///< s x r: P_s^T Omega, nodal values to Fourier coefficients; P_s^{-1} for r = s
  Matrix<S> projection_hat;  ///< s x k: P_hat^T Omega_hat
  Matrix<S> A;            ///< r x r: P_s X_s P_s^T Omega, for r = s the Butcher matrix of the s-stage Gauss method (30)
  Vector<S> lambda_at_1;  ///< s: of the unknowns of lambda, what they add to lambda(1): l_i(1) of (57), or P_l(1)

  /// Whether the unknowns of lambda are its coefficients, and not its values at the nodes.
  bool has_coefficients_of_lambda() const { return r > s; }
};

/// Every coefficient is computed with guard digits and rounded once.
/// \throws InputError unless 1 <= s <= k, s <= r, s <= max_s, k <= max_k and r <= max_k
template <Scalar S>
Hbvm<S> make_hbvm(int k, int s, int r);
/// The paper's method, r = s.
template <Scalar S>
Hbvm<S> make_hbvm(int k, int s) {
  return make_hbvm<S>(k, s, s);
}

/// The method with all coefficients rounded to double, for Jacobians and start values.
template <Scalar S>
Hbvm<double> in_double(const Hbvm<S>& method);

}  // namespace hbvm::core
