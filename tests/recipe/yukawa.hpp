#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// A screened charge: U = -strength Q_a Q_b exp(-r/length) / r.
struct Yukawa {
  static constexpr std::string_view kind = "yukawa";
  static constexpr Acts acts = Acts::between_pairs;  // or about_a_center, on_each_body
  static constexpr bool needs_mass = false, needs_charge = true;
  static constexpr std::array<EffectKey, 2> keys{{{"strength"}, {"length"}}};
  static constexpr Symmetry symmetry = Symmetry::central;                // U depends on r alone
  static constexpr std::array<std::string_view, 1> factors{"strength"};  // keys that U is proportional to

  template <class T>
  static T U(const Interaction<T>& pair) {
    using std::exp;
    const T r = pair.distance();
    return -(pair.number("strength") * pair.charges[0] * pair.charges[1] * exp(-(r / pair.number("length"))) / r);
  }
};

}  // namespace hbvm::core
