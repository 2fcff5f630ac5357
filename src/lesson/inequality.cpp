#include "lesson/inequality.hpp"

namespace hbvm::core {

Inequality Inequality::parse(std::string_view text) {
  const std::size_t at = text.find('<');
  if (at == std::string_view::npos)
    throw ExpressionError("'" + std::string(text) + "' is no inequality: use A <= B or A < B");
  const bool strictly = text.substr(at + 1, 1) != "=";
  return {Expression::parse(text.substr(0, at)), Expression::parse(text.substr(at + (strictly ? 1 : 2))), strictly};
}

bool Inequality::holds(const Constants& numbers) const {
  constexpr int bits = 128;  // both sides are rounded to nearest, so that equal numbers stay equal
  const BigFloat a = left.evaluate_to_bits(bits, numbers), b = right.evaluate_to_bits(bits, numbers);
  const int order = mpfr_cmp(raw(a), raw(b));
  return strictly ? order < 0 : order <= 0;
}

}  // namespace hbvm::core
