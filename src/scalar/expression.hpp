#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "hbvm/error.hpp"
#include "scalar/big_float.hpp"

namespace hbvm::core {

class Expression;

/// Named values an expression may refer to; they may refer to one another.
using Constants = std::map<std::string, Expression, std::less<>>;

/// An expression that cannot be read or has no value. Carries the whole story in what().
class ExpressionError : public InputError {
 public:
  explicit ExpressionError(const std::string& reason) : InputError(reason), reason_(reason) {}
  /// \param at of the text, from 0, is where the reason lies
  ExpressionError(std::string_view text, std::size_t at, std::string reason);
  /// \param text has no value
  ExpressionError(std::string_view text, std::string reason);

  /// Without the text and its column.
  const std::string& reason() const { return reason_; }
  std::size_t at() const { return at_; }

 private:
  std::string reason_;
  std::size_t at_ = 0;
};

/// An exact number as text: decimals, names, pi, + - * / ^ ( ). There are functions of one argument: sqrt sin cos tan
/// exp log sinh cosh tanh asin acos atan abs. atan2(y, x) is the angle of the point (x, y), in (-pi, pi]. `^` binds
/// tighter than a sign on its left and associates to the right: -2^2 = -4, 2^3^2 = 512.
///
/// Or a formula, which may have line breaks, and names with a dot, a.x, in it: some of its names stand for what varies.
/// Or an observation, a formula whose names may also have two dots, or be those of quantities: distance(a, b).
class Expression {
 public:
  enum class Syntax { number, formula, observation };
  /// \throws ExpressionError with the column of the first character that does not fit
  static Expression parse(std::string_view text, Syntax syntax = Syntax::number);

  /// The value rounded correctly, to nearest, to `bits` significand bits. The expression is enclosed between bounds of
  /// growing working precision until both round to the same number. What still cannot be told from 0 at four times
  /// `bits` is 0, provided it is less than 2^(-2 bits) there. Else digits are added as long as they can help.
  /// \throws ExpressionError for an unknown or circular name, a division by 0, a root or logarithm outside its
  ///         domain, magnitudes beyond 2^131072, and if it would take too long
  BigFloat evaluate_to_bits(int bits, const Constants& constants = {}) const;

  /// Names used that are neither functions nor pi.
  std::set<std::string> names() const;
  const std::string& text() const { return text_; }

  struct Node;
  const std::shared_ptr<const Node>& root() const { return root_; }
  /// The expression that is a part of this one.
  Expression part(std::shared_ptr<const Node> node) const { return {text_, std::move(node)}; }

  /// The words that are functions or pi, and no names.
  static const std::set<std::string, std::less<>>& reserved_words();

 private:
  Expression(std::string text, std::shared_ptr<const Node> root) : text_(std::move(text)), root_(std::move(root)) {}
  friend class Encloser;
  std::string text_;
  std::shared_ptr<const Node> root_;
};

}  // namespace hbvm::core
