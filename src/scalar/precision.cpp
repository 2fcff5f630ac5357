#include "scalar/precision.hpp"

#include <charconv>

#include "hbvm/error.hpp"
#include "scalar/quad.hpp"

namespace hbvm::core {

Precision Precision::parse(std::string_view name) {
  if (name == "double") return {Kind::binary64, 15};
  if (name == "quad") {
    if (has_quad) return {Kind::binary128, 33};
    throw InputError(
        "precision 'quad' is not in this build of hbvm (HBVM_QUAD is off): use mpfr:34, of as many digits");
  }
  constexpr std::string_view prefix = "mpfr:";
  const bool digits_alone = !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
  if (name.starts_with(prefix) || digits_alone) {
    const std::string_view number = digits_alone ? name : name.substr(prefix.size());
    unsigned digits = 0;
    const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), digits);
    if (status == std::errc() && end == number.data() + number.size() && digits >= min_digits && digits <= max_digits)
      return {Kind::mpfr, digits};
    throw InputError("precision '" + std::string(name) + "': mpfr:N takes a whole number of digits from " +
                     std::to_string(min_digits) + " to " + std::to_string(max_digits));
  }
  throw InputError("unknown precision '" + std::string(name) + "': use double, quad or mpfr:N, or N alone (N digits)");
}

std::string Precision::name() const {
  if (kind_ == Kind::binary64) return "double";
  if (kind_ == Kind::binary128) return "quad";
  return "mpfr:" + std::to_string(digits_);
}

const char* precision_of_34_digits() { return has_quad ? "quad" : "mpfr:34"; }

}  // namespace hbvm::core
