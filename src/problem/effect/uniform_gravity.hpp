#pragma once

#include <array>

#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// A uniform field: U = sum m a.q, with a the acceleration (for a mass matrix M: a.M q).
struct UniformGravity {
  static constexpr std::string_view kind = "uniform_gravity";
  static constexpr Acts acts = Acts::on_each_body;
  static constexpr bool needs_mass = false, needs_charge = false;
  static constexpr std::array<EffectKey, 1> keys{{{"acceleration", true}}};
  static constexpr Symmetry symmetry = Symmetry::planar;
  static constexpr EffectAxis axis{"acceleration", true};
  static constexpr std::array<std::string_view, 0> factors{};

  template <class T>
  static T U(const Interaction<T>& body) {
    return Interaction<T>::dot(body.mass_times(body.vector("acceleration")), body.x);
  }
};

}  // namespace hbvm::core
