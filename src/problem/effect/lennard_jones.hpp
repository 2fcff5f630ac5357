#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// The 12-6 potential: U = -4 depth ((diameter/r)^12 - (diameter/r)^6).
struct LennardJones {
  static constexpr std::string_view kind = "lennard_jones";
  static constexpr Acts acts = Acts::between_pairs;
  static constexpr bool needs_mass = false, needs_charge = false;
  static constexpr std::array<EffectKey, 2> keys{{{"depth"}, {"diameter"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 2> factors{"depth", "diameter"};

  template <class T>
  static T U(const Interaction<T>& pair) {
    const T diameter = pair.number("diameter");
    const T sixth = power(T(diameter * diameter / pair.squared_distance()), 3);
    return -(4 * pair.number("depth") * (sixth * sixth - sixth));
  }
};

}  // namespace hbvm::core
