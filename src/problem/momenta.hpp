#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace hbvm::core {

/// A component of momentum, linear.P + angular.L. There P = sum p over what translates with space, L = sum q x p, about
/// the origin, over all blocks of coordinates. With both parts it is an angular momentum about another point (or a
/// screw's).
template <Scalar S>
struct MomentumComponent {
  Vector<S> angular;  ///< three entries; in the plane one, about z
  Vector<S> linear;   ///< one a dimension

  bool is_linear() const { return max_norm(angular) == 0; }
  /// "P_x", "L_x + 1.5 L_y + 3 L_z".
  std::string name() const;
};

/// P_x, P_y … (if something translates) and L_x … or L_z alone.
template <Scalar S>
std::vector<MomentumComponent<S>> coordinate_momenta(const Problem<S>& problem);

/// Its value, and the sum of the magnitudes of its terms, which its round-off is proportional to.
template <Scalar S>
struct MomentumValue {
  S value = 0, size = 0;
};
template <Scalar S>
MomentumValue<S> momentum(const Problem<S>& problem, const MomentumComponent<S>& component, const Vector<S>& q,
                          const Vector<S>& p);

/// A basis of the components that the problem conserves because of a symmetry. The translation, rotation or screw along
/// it changes neither the kinetic energy nor any one effect or constraint, however weak that is beside others. It is
/// decided from what they depend on, with no tolerance but the round-off of the scene's numbers. It scales exactly with
/// units that are powers of two. (Effects that break a symmetry and would restore it together are taken to break it.)
/// Linear components come first; each is led by the coefficient 1, and a component along an axis that is conserved
/// stands alone.
template <Scalar S>
std::vector<MomentumComponent<S>> conserved_momenta(const Problem<S>& problem);

}  // namespace hbvm::core
