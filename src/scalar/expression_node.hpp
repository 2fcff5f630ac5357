#pragma once

#include <memory>
#include <string>

#include "scalar/expression.hpp"

namespace hbvm::core {

/// One operation of a parsed expression.
struct Expression::Node {
  enum class Kind {
    decimal,
    pi,
    name,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    sqrt,
    sin,
    cos,
    tan,
    exp,
    log,
    sinh,
    cosh,
    tanh,
    asin,
    acos,
    atan,
    atan2,
    abs
  };
  Kind kind;
  std::string text;                         ///< of a decimal or a name
  std::shared_ptr<const Node> left, right;  ///< of a function its arguments
  std::size_t at = 0;                       ///< where in the text it stands: of an operation its sign
};

}  // namespace hbvm::core
