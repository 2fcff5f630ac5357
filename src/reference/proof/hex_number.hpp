#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scalar/arb.hpp"

namespace hbvm::core {

/// A number without a radius as text, exactly: "-1a3p-2c" is -0x1a3 times 2^-0x2c.
std::string hex_text(const RealBall& x);
std::string hex_text(double x);

/// The number of such a text. Nothing for another text, and for an exponent beyond 2^20 bits.
std::optional<RealBall> number_of_hex(std::string_view text);

}  // namespace hbvm::core
