#pragma once

#include <array>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// F = Q v x B, with B across the plane if that is all of space. It does no work.
struct MagneticField {
  static constexpr std::string_view kind = "magnetic_field";
  static constexpr ForceOn on = ForceOn::charged_body;
  static constexpr bool works = false;
  static constexpr std::array<ForceKey, 1> keys{{{"B", ForceKey::Components::axial, {}, true}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& body) {
    return body.times(-body.parameters[0], body.turned(body.vector("B"), body.v[0]));
  }
};

}  // namespace hbvm::core
