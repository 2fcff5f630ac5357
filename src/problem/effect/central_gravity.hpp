#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// Attraction of each body by a fixed centre: U = strength m / r. (strength is G times the centre's mass.)
struct CentralGravity {
  static constexpr std::string_view kind = "central_gravity";
  static constexpr Acts acts = Acts::about_a_center;
  static constexpr bool needs_mass = true, needs_charge = false;
  static constexpr std::array<EffectKey, 1> keys{{{"strength"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"strength"};

  template <class T>
  static T U(const Interaction<T>& body) {
    return body.number("strength") * body.masses[0] / body.distance();
  }
};

}  // namespace hbvm::core
