#pragma once

#include <array>
#include <cmath>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// The resistance of a medium at rest: F = -linear v - quadratic |v| v, of a rigid body at its centre of mass.
struct Drag {
  static constexpr std::string_view kind = "drag";
  static constexpr ForceOn on = ForceOn::each_body;
  static constexpr bool works = true;
  static constexpr std::array<ForceKey, 2> keys{
      {{"linear", ForceKey::Components::one, "0"}, {"quadratic", ForceKey::Components::one, "0"}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& body) {
    using std::sqrt;
    const std::vector<T>& v = body.v[0];
    T factor = body.number("linear");
    if (!body.is_zero("quadratic")) factor = factor + body.number("quadratic") * sqrt(body.dot(v, v));
    return body.times(-factor, v);
  }
};

}  // namespace hbvm::core
