#include "hex_number.hpp"

namespace hbvm::core {
namespace {

/// A sign and digits.
bool is_whole(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace

std::string hex_text(const RealBall& x) {
  char* const dumped = arf_dump_str(arb_midref(raw(x)));
  std::string text = dumped;
  flint_free(dumped);
  text[text.find(' ')] = 'p';
  return text;
}

std::string hex_text(double x) { return hex_text(exact_ball(x)); }

std::optional<RealBall> number_of_hex(std::string_view text) {
  const auto p = text.find('p');
  if (p == std::string_view::npos) return std::nullopt;
  const std::string_view mantissa = text.substr(0, p), exponent = text.substr(p + 1);
  constexpr std::size_t longest_exponent = 6;  // with its sign
  if (!is_whole(mantissa) || !is_whole(exponent) || exponent.size() > longest_exponent) return std::nullopt;
  RealBall x;
  if (arf_load_str(arb_midref(raw(x)), (std::string(mantissa) + ' ' + std::string(exponent)).c_str()) != 0)
    return std::nullopt;
  return x;
}

}  // namespace hbvm::core
