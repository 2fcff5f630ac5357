#pragma once

#include <array>

#include "hbvm/error.hpp"
#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// A harmonic or quartic well about a fixed centre: U = -stiffness/exponent r^exponent, exponent 2 or 4.
struct Trap {
  static constexpr std::string_view kind = "trap";
  static constexpr Acts acts = Acts::about_a_center;
  static constexpr bool needs_mass = false, needs_charge = false;
  static constexpr std::array<EffectKey, 2> keys{{{"stiffness"}, {"exponent"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"stiffness"};

  template <class T>
  static T U(const Interaction<T>& body) {
    const auto exponent = body.whole("exponent");
    if (exponent != 2 && exponent != 4) throw InputError("'exponent' must be 2 or 4");
    return -(body.number("stiffness") / body.number("exponent") * power(body.squared_distance(), *exponent / 2));
  }
};

}  // namespace hbvm::core
