#pragma once

#include <string>
#include <string_view>

#include "scalar/expression.hpp"

namespace hbvm::core {

/// What must hold of numbers: "A <= B" or "A < B", two expressions over names.
struct Inequality {
  Expression left, right;
  bool strictly = false;

  /// \throws ExpressionError
  static Inequality parse(std::string_view text);
  /// \throws ExpressionError for a name that is not among the numbers, and where a side has no value
  bool holds(const Constants& numbers) const;
};

}  // namespace hbvm::core
