#pragma once

#include <array>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// A linear damper along the line between two: F = -coefficient (x.v)/(x.x) x, so the coefficient times the speed at
/// which they part.
struct Damper {
  static constexpr std::string_view kind = "damper";
  static constexpr ForceOn on = ForceOn::pair;
  static constexpr bool works = true;
  static constexpr std::array<ForceKey, 1> keys{{{"coefficient"}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& pair) {
    const std::vector<T>&x = pair.x[0], &v = pair.v[0];
    const T squared = pair.dot(x, x);
    const T rate = pair.dot(x, v) / squared;
    return pair.times(-(pair.number("coefficient") * rate), x);
  }
};

}  // namespace hbvm::core
