#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// Charges, of bodies or fixed points: U = -strength Q_a Q_b / r; like charges repel for strength > 0.
struct Coulomb {
  static constexpr std::string_view kind = "coulomb";
  static constexpr Acts acts = Acts::between_pairs;
  static constexpr bool needs_mass = false, needs_charge = true;
  static constexpr std::array<EffectKey, 1> keys{{{"strength"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"strength"};

  template <class T>
  static T U(const Interaction<T>& pair) {
    return -(pair.number("strength") * pair.charges[0] * pair.charges[1] / pair.distance());
  }
};

}  // namespace hbvm::core
