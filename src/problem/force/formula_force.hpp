#pragma once

#include <array>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// F by formulas of positions, velocities and t: of each body by itself, or of several, one after the other.
struct FormulaForce {
  static constexpr std::string_view kind = "force";
  static constexpr ForceOn on = ForceOn::each_body;
  static constexpr bool works = true;
  static constexpr std::array<ForceKey, 1> keys{{{"F", ForceKey::Components::space, {}, true}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& of) {
    return of.vector("F");
  }
};

}  // namespace hbvm::core
