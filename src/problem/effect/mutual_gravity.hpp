#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// Newton's attraction of bodies by one another: U = strength m_a m_b / r.
struct MutualGravity {
  static constexpr std::string_view kind = "mutual_gravity";
  static constexpr Acts acts = Acts::between_pairs;
  static constexpr bool needs_mass = true, needs_charge = false;
  static constexpr std::array<EffectKey, 1> keys{{{"strength"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"strength"};

  template <class T>
  static T U(const Interaction<T>& pair) {
    return pair.number("strength") * pair.masses[0] * pair.masses[1] / pair.distance();
  }
};

}  // namespace hbvm::core
