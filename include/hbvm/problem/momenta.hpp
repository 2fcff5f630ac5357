#pragma once

#include <string>
#include <vector>

#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// A component of linear or angular momentum (about the origin): P_x, L_z …
struct MomentumComponent {
  bool angular = false;
  int axis = 0;  ///< of P: 0, 1, 2; of L: the axis of rotation (2 in the plane)
  std::string name() const { return std::string(angular ? "L_" : "P_") + "xyz"[axis]; }
};

/// Its value: P = sum p over what translates with space, L = sum q x p over all blocks of coordinates.
template <Scalar S>
S momentum(const Problem<S>& problem, const MomentumComponent& component, const Vector<S>& q, const Vector<S>& p);

/// The components that the problem conserves because of a symmetry: translation along an axis, or rotation about one
/// through the origin, changes neither U nor g nor the kinetic energy. Decided by the derivatives along the symmetry at
/// several points near q, which vanish but for round-off only if it is one.
template <Scalar S>
std::vector<MomentumComponent> conserved_momenta(const Problem<S>& problem, const Vector<S>& q);

#define HBVM_DECLARE(S)                                                                                           \
  extern template S momentum<S>(const Problem<S>&, const MomentumComponent&, const Vector<S>&, const Vector<S>&); \
  extern template std::vector<MomentumComponent> conserved_momenta<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
