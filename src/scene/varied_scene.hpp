#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// A number of a scene, named as with_number() names it, and the values that it takes.
struct VariedNumber {
  std::string name;
  std::vector<Expression> values;
};

/// So many values at equal distances, two or more, as exact expressions.
std::vector<Expression> values_between(const Expression& from, const Expression& to, long count);

/// A scene with a value of each number.
struct VariedScene {
  Scene scene;
  std::vector<Expression> values;

  /// The values, rounded, with the constants of this scene.
  std::vector<double> near() const;
};

/// All combinations, the last number the fastest. \throws InputError as with_number() does
std::vector<VariedScene> varied_scenes(const Scene& scene, const std::vector<VariedNumber>& numbers);

}  // namespace hbvm::core
