#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "hbvm/error.hpp"
#include "hbvm/scalar/big_float.hpp"

namespace hbvm {

class Expression;

/// Named values an expression may refer to; they may refer to one another.
using Constants = std::map<std::string, Expression, std::less<>>;

/// An expression that cannot be read or has no value. Carries the whole story in what().
class ExpressionError : public InputError {
 public:
  using InputError::InputError;
};

/// An exact number as text: decimals, names, + - * / ^ ( ), sqrt sin cos exp log, pi. `^` binds tighter than a sign
/// on its left and associates to the right: -2^2 = -4, 2^3^2 = 512.
class Expression {
 public:
  /// \throws ExpressionError with the column of the first character that does not fit
  static Expression parse(std::string_view text);

  /// The value rounded correctly, to nearest, to `bits` significand bits. The expression is enclosed between bounds of
  /// growing working precision until both round to the same number. What still cannot be told from 0 at four
  /// times `bits` is 0, provided it is less than 2^(-2 bits) there; else digits are added as long as they can help.
  /// \throws ExpressionError for an unknown or circular name, a division by 0, a root or logarithm outside its
  ///         domain, magnitudes beyond 2^131072, and if it would take too long
  BigFloat evaluate_to_bits(int bits, const Constants& constants = {}) const;

  /// Names used that are neither functions nor pi.
  std::set<std::string> names() const;
  const std::string& text() const { return text_; }

  struct Node;

 private:
  Expression(std::string text, std::shared_ptr<const Node> root) : text_(std::move(text)), root_(std::move(root)) {}
  friend class Encloser;
  std::string text_;
  std::shared_ptr<const Node> root_;
};

}  // namespace hbvm
