#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// The J2 term of an oblate centre's field, without its monopole (see central_gravity). With the sine z = axis.x/r of
/// the latitude it is U = -strength m J2 radius^2 (3 z^2 - 1) / (2 r^3). The axis may have any length.
struct Oblateness {
  static constexpr std::string_view kind = "oblateness";
  static constexpr Acts acts = Acts::about_a_center;
  static constexpr bool needs_mass = true, needs_charge = false;
  static constexpr std::array<EffectKey, 4> keys{{{"strength"}, {"radius"}, {"J2"}, {"axis", true}}};
  static constexpr Symmetry symmetry = Symmetry::axial;
  static constexpr EffectAxis axis{"axis"};
  static constexpr std::array<std::string_view, 3> factors{"strength", "radius", "J2"};

  template <class T>
  static T U(const Interaction<T>& body) {
    const std::vector<T>& direction = body.vector("axis");
    const T along = Interaction<T>::dot(direction, body.x);
    const T r2 = body.squared_distance(), r = body.distance();
    const T radius = body.number("radius");
    const T factor = body.number("strength") * body.number("J2") * radius * radius / 2 * body.masses[0];
    const T below = Interaction<T>::dot(direction, direction) * r2;
    const T z2 = along * along / below;
    const T r3 = r2 * r;
    return -(factor * (3 * z2 - 1) / r3);
  }
};

}  // namespace hbvm::core
