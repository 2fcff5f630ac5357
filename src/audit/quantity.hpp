#pragma once

#include <string_view>

namespace hbvm::core {

/// What a claim is about. Errors are max-norms.
enum class Quantity {
  q,                 ///< position
  p,                 ///< momentum as it is propagated
  tangential_p,      ///< momentum of the output state, projected to the tangent space
  lagmul,            ///< multiplier extrapolated from the nodes, (57)
  output_lambda,     ///< multiplier of the output state, Theorem 1
  q_between,         ///< position at five points within a step, as BetweenSteps finds it
  p_between,         ///< tangential momentum likewise
  lambda_between,    ///< multiplier likewise
  delta_lambda,      ///< lambda(u(c_j h), v(c_j h)) - lambda_j at the internal nodes, (33)
  polynomials,       ///< u and v at eight points of a step, of Corollary 2
  g,                 ///< constraints
  hidden,            ///< hidden constraints grad g^T M^-1 p, (15)
  H,                 ///< energy
  balance,           ///< H - W, the energy less the work done
  angular_momentum,  ///< every momentum that the problem conserves
  reversal,          ///< the start, after as many steps back (momenta reversed) as forth
  hidden_constant,   ///< hidden constraint over its leading term, for a constant Gram matrix
  hidden_drift,      ///< growth of the hidden constraint from t = 20 to t = 1280
  sweeps,            ///< sweeps of (55) a step, less those of k = s
  order_conditions,  ///< order that a Runge-Kutta tableau has by the order conditions
  B,                 ///< condition B(2k) of the tableau, and B(2s) of the constraints' nodes
  C,                 ///< condition C(s)
  D,                 ///< condition D(s), D(s - 1) for k > s
  X,                 ///< X_s = P_s^-1 I_s, (31), P_s^T Omega = P_s^-1, and P_0 = 1
  symmetry,          ///< c_i + c_{s+1-i} = 1, b_i = b_{s+1-i}, and A likewise
  W                  ///< P_s^-1 A P_s = X_s, the W-transformation
};

/// Its name in tables and claims files: "tangential p".
std::string_view name_of(Quantity quantity);
/// Also accepts '_' and '-' for the blank. \throws InputError
Quantity parse_quantity(std::string_view name);

}  // namespace hbvm::core
