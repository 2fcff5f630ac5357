#pragma once

#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// The largest of |A_{s+1-i,s+1-j} + A_ij - b_j| and |b_{s+1-i} - b_i|. It is 0 for a method that is its own adjoint.
/// Its stages have to stand in the order that the adjoint reverses (Hairer, Lubich, Wanner: Geometric Numerical
/// Integration, theorem V.2.3).
template <Scalar S>
S symmetry_defect(const RungeKutta<S>& method);

/// The largest |b_i A_ij + b_j A_ji - b_i b_j|. It is 0 for a method that conserves quadratic invariants, and so is
/// symplectic (the same, theorems IV.2.2 and VI.4.3).
template <Scalar S>
S symplecticity_defect(const RungeKutta<S>& method);

}  // namespace hbvm::core
