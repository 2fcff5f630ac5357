#pragma once

#include "hbvm/linear/matrix.hpp"
#include "hbvm/method/hbvm_name.hpp"

namespace hbvm {

/// The coefficients of HBVM(k, s), k >= s >= 1: all a step needs and no more. They do not depend on the step.
/// Names and labels are the paper's: (matrici), (Xs), (new). k = s is the s-stage Gauss method.
template <Scalar S>
struct Hbvm {
  int k = 0, s = 0;
  Vector<S> c, b;            ///< the s nodes and weights where the constraints are met
  Vector<S> c_hat, b_hat;    ///< the k nodes and weights of the potential's integrals (psij)
  Matrix<S> P_s, I_s;        ///< s x s: P_j(c_i) and int_0^{c_i} P_j
  Matrix<S> P_hat, I_hat;    ///< k x s: the same at c_hat
  Matrix<S> X_s;             ///< s x s, tridiagonal: I_s = P_s X_s (IsPs)
  Matrix<S> projection;      ///< s x s: P_s^T Omega = P_s^{-1}, nodal values to Fourier coefficients
  Matrix<S> projection_hat;  ///< s x k: P_hat^T Omega_hat
  Matrix<S> A;               ///< s x s: I_s P_s^T Omega, the Butcher matrix of the s-stage Gauss method (azzera1)
  Vector<S> lagrange_at_1;   ///< s: l_i(1) of (lagmul)
};

/// Every coefficient is computed with guard digits and rounded once.
/// \throws InputError unless 1 <= s <= k, s <= max_s and k <= max_k
template <Scalar S>
Hbvm<S> make_hbvm(int k, int s);

/// The method with all coefficients rounded to double, for Jacobians and start values.
template <Scalar S>
Hbvm<double> in_double(const Hbvm<S>& method);

#define HBVM_DECLARE(S)                           \
  extern template Hbvm<S> make_hbvm<S>(int, int); \
  extern template Hbvm<double> in_double<S>(const Hbvm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
