#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// The cosine of the distance to a fixed centre, of the paper's satellites (67): U = strength cos r.
struct RadialCosine {
  static constexpr std::string_view kind = "radial_cosine";
  static constexpr Acts acts = Acts::about_a_center;
  static constexpr bool needs_mass = false, needs_charge = false;
  static constexpr std::array<EffectKey, 1> keys{{{"strength"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"strength"};

  template <class T>
  static T U(const Interaction<T>& body) {
    using std::cos;
    return body.number("strength") * cos(body.distance());
  }
};

}  // namespace hbvm::core
