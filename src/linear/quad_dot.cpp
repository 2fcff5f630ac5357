#include "linear/quad_dot.hpp"

#if HBVM_QUAD

namespace hbvm::core {
namespace {

using namespace binary128;

/// The sum of the biased exponents of two factors, or 0 if one is 0. \return false if one is neither 0 nor normal
bool exponent_of_product(unsigned& exponent, const Bits& a, const Bits& b) {
  exponent = a.zero() || b.zero() ? 0 : a.exponent() + b.exponent();
  return (a.zero() || a.normal()) && (b.zero() || b.normal());
}

/// The significand with its leading bit as the highest.
Wide significand(const Bits& a) { return wide(a.significand_high(), a.low) << 15; }

}  // namespace

bool dot(Quad& r, const Quad* x, long x_stride, const Quad* y, long y_stride, long n) {
  constexpr long most = 256;
  if (n > most) return false;
  const auto bits = [](const Quad* a, long i) { return bits_of(a[i].backend().value()); };
  unsigned greatest = 0, exponent = 0;
  for (long i = 0; i < n; ++i) {
    if (!exponent_of_product(exponent, bits(x, i * x_stride), bits(y, i * y_stride))) return false;
    greatest = exponent > greatest ? exponent : greatest;
  }
  // Products are in units of 2^-120 of the greatest binade, where 256 of them have room.
  constexpr unsigned room = 8, least = Bits::bias + 256, highest = Bits::bias + Bits::exponent_mask - 32;
  if (greatest > 0 && (greatest < least || greatest > highest)) return false;
  Wide sum = 0;
  for (long i = 0; i < n; ++i) {
    const Bits a = bits(x, i * x_stride), b = bits(y, i * y_stride);
    exponent_of_product(exponent, a, b);
    const unsigned down = greatest + room - exponent;
    if (exponent == 0 || down >= 128) continue;
    const Wide size = high_product(significand(a), significand(b)) >> down;
    const Wide negative = -Wide{(a.high ^ b.high) >> 63};
    sum += (size ^ negative) - negative;
  }
  const std::uint64_t sign = high_of(sum) & Bits::sign;
  if (sign != 0) sum = -sum;
  Bits result{0, 0};
  if (sum != 0) {
    const int zeros = leading_zeros(sum);
    result = rounded(sum << zeros, greatest + room + 1 - Bits::bias - static_cast<unsigned>(zeros), sign);
  }
  set_bits(r.backend().value(), result);
  return true;
}

}  // namespace hbvm::core

#endif
