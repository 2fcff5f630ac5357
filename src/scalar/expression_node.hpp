#pragma once

#include <memory>
#include <string>

#include "hbvm/scalar/expression.hpp"

namespace hbvm {

/// One operation of a parsed expression.
struct Expression::Node {
  enum class Kind { decimal, pi, name, negate, add, subtract, multiply, divide, power, sqrt, sin, cos, exp, log };
  Kind kind;
  std::string text;  ///< of a decimal or a name
  std::shared_ptr<const Node> left, right;
};

}  // namespace hbvm
