#pragma once

#include <string_view>

#include "scalar/expression.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// The value of an expression in the working precision, right to the last bit.
/// \throws ExpressionError as Expression::evaluate_to_bits does, and if the value overflows or underflows S
template <Scalar S>
S evaluate(const Expression& expression, const Constants& constants = {}) {
  BigFloat exact = expression.evaluate_to_bits(significand_bits<S>(), constants);
  if constexpr (!std::same_as<S, Mpfr>) {
    // Below the normal range numbers have fewer bits: not to round twice, round there from many more.
    if (mpfr_regular_p(raw(exact)) && mpfr_get_exp(raw(exact)) < std::numeric_limits<S>::min_exponent)
      exact = expression.evaluate_to_bits(4 * significand_bits<S>(), constants);
  }
  S value = rounded_to<S>(raw(exact));
  if (!is_finite(value) || (value == 0) != (mpfr_zero_p(raw(exact)) != 0))
    throw ExpressionError("'" + expression.text() + "' is outside the range of the working precision");
  return value;
}

/// The number written as exact text: `literal<S>("0.1")`, `literal<S>("2^(3/4)*pi/5")`.
template <Scalar S>
S literal(std::string_view text) {
  return evaluate<S>(Expression::parse(text));
}

}  // namespace hbvm::core
