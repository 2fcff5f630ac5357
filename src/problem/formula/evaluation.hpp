#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "problem/effect/interaction.hpp"
#include "problem/formula/input.hpp"
#include "scalar/expression_node.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

/// The value of a formula over a number type T: the scalars S themselves, or `Traced<S>`. Parts without variables are
/// numbers, right to the last bit of S. Whole powers are products, those of halves have a root; other powers are
/// exp(b log a).
///
/// \tparam Derived has `T constant(const S&)` and `void check(const Node&, const T&)`, which sees every value
template <class Derived, Scalar S, class T>
class FormulaEvaluation {
 public:
  using Node = Expression::Node;
  using NodePtr = std::shared_ptr<const Node>;

  FormulaEvaluation(const FormulaInput<S>& input, const std::vector<T>& inputs, const std::vector<T>& parameters)
      : formula_(input.formula), constants_(input.constants) {
    const auto d = static_cast<std::size_t>(input.dimension);
    const auto difference = [&](std::size_t i) {
      return input.arguments - (input.timed ? 1 : 0) == 1 ? inputs[i] : T(inputs[i] - inputs[d + i]);
    };
    for (const auto& [name, variable] : input.variables) {
      if (variable.is == FormulaVariable::Is::input) {
        values_.emplace(name, inputs[variable.index]);
      } else if (variable.is == FormulaVariable::Is::parameter) {
        values_.emplace(name, parameters[variable.index]);
      } else if (variable.is == FormulaVariable::Is::difference) {
        values_.emplace(name, difference(variable.index));
      } else {
        using std::sqrt;
        std::vector<T> x;
        for (std::size_t i = 0; i < d; ++i) x.push_back(difference(i));
        const T square = Interaction<T>::dot(x, x);
        values_.emplace(name, sqrt(square));
        squares_.emplace(name, square);
      }
    }
  }

  T value() { return value(formula_.root()); }

 private:
  static constexpr long most_exponent = 1000;

  bool varies(const Node& node) {
    if (const auto known = varies_.find(&node); known != varies_.end()) return known->second;
    const bool result = node.kind == Node::Kind::name
                            ? values_.contains(node.text)
                            : (node.left && varies(*node.left)) || (node.right && varies(*node.right));
    return varies_[&node] = result;
  }

  S number(const NodePtr& node) const {
    try {
      return evaluate<S>(formula_.part(node), constants_);
    } catch (const ExpressionError& error) {
      throw ExpressionError(formula_.text(), node->at, error.reason());
    }
  }

  T value(const NodePtr& node) {
    Derived& self = static_cast<Derived&>(*this);
    if (!varies(*node)) return self.constant(number(node));
    T result = operation(*node);
    self.check(*node, result);
    return result;
  }

  T operation(const Node& node) {
    using Kind = Node::Kind;
    using std::abs, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tanh;
    if (node.kind == Kind::name) return values_.find(node.text)->second;
    if (node.kind == Kind::power) return power_of(node);
    const T a = value(node.left);
    switch (node.kind) {
      case Kind::negate:
        return -a;
      case Kind::add:
        return a + value(node.right);
      case Kind::subtract:
        return a - value(node.right);
      case Kind::multiply:
        return a * value(node.right);
      case Kind::divide:
        return a / value(node.right);
      case Kind::sqrt:
        return sqrt(a);
      case Kind::sin:
        return sin(a);
      case Kind::cos:
        return cos(a);
      case Kind::tan: {
        const T cosine = cos(a);
        return sin(a) / cosine;
      }
      case Kind::exp:
        return exp(a);
      case Kind::log:
        return log(a);
      case Kind::sinh:
        return sinh(a);
      case Kind::cosh:
        return cosh(a);
      case Kind::tanh:
        return tanh(a);
      case Kind::asin: {
        const T above = a + 1;
        return atan(a / sqrt((1 - a) * above));
      }
      case Kind::acos: {
        const T above = a + 1;
        return 2 * atan(sqrt((1 - a) / above));
      }
      case Kind::atan:
        return atan(a);
      case Kind::atan2: {
        // Half the angle, whose tangent has no pole but at the angle pi.
        const T x = value(node.right);
        const T square = a * a;
        return 2 * atan(a / (sqrt(x * x + square) + x));
      }
      case Kind::abs:
        return abs(a);
      default:  // decimal, pi
        break;
    }
    throw Error("a number does not vary");
  }

  T power_of(const Node& node) {
    using std::exp, std::floor, std::log, std::sqrt;
    if (varies(*node.right)) {
      const T exponent = value(node.right);
      return exp(exponent * log(value(node.left)));
    }
    const S exponent = number(node.right), halves = 2 * exponent;
    if (floor(halves) != halves) {
      const T base = value(node.left);
      return exp(static_cast<Derived&>(*this).constant(exponent) * log(base));
    }
    if (!(magnitude(exponent) <= most_exponent))
      throw ExpressionError(formula_.text(), node.at, "the exponent must be from -1000 to 1000");
    const long n = static_cast<long>(halves), size = n < 0 ? -n : n;
    if (n == 0) return static_cast<Derived&>(*this).constant(S(1));
    std::optional<T> result;
    if (size > 1) result = whole_power(node.left, size / 2);
    if (size % 2 == 1) {
      const T root = sqrt(value(node.left));
      result = result ? T(*result * root) : root;
    }
    return n < 0 ? T(1 / *result) : *result;
  }

  /// base^n, n >= 1; even powers of a distance are polynomials.
  T whole_power(const NodePtr& base, long n) {
    const auto square = base->kind == Node::Kind::name ? squares_.find(base->text) : squares_.end();
    if (square == squares_.end() || n == 1) return power(value(base), n);
    const T even = power(square->second, n / 2);
    return n % 2 == 0 ? even : T(even * value(base));
  }

  const Expression& formula_;
  const Constants& constants_;
  std::map<std::string, T, std::less<>> values_, squares_;
  std::unordered_map<const Node*, bool> varies_;
};

}  // namespace hbvm::core
