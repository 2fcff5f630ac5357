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

/// A whole number of 192 bits in two's complement.
struct Sum {
  Wide high = 0;
  std::uint64_t low = 0;

  /// Adds x, or with all bits of `negative` set subtracts it.
  void add(const Sum& x, std::uint64_t negative) {
    const std::uint64_t part = x.low ^ negative;
    low += part;
    std::uint64_t carry = low < part;
    low += negative & 1;
    carry += low < (negative & 1);
    high += (x.high ^ wide(negative, negative)) + carry;
  }
  bool negative() const { return high_of(high) >> 63 != 0; }
  void negate() {
    low = -low;
    high = ~high + (low == 0);
  }
};

/// The first 192 of the 256 bits of a product of significands, divided by 2^down, cut.
Sum product_of(const Bits& a, const Bits& b, unsigned down) {
  // With the leading bit as the highest.
  const Wide x = wide(a.significand_high(), a.low) << 15, y = wide(b.significand_high(), b.low) << 15;
  const Wide left = Wide{high_of(x)} * low_of(y), right = Wide{low_of(x)} * high_of(y);
  const Wide middle = Wide{low_of(left)} + low_of(right) + high_of(Wide{low_of(x)} * low_of(y));
  const Wide top = Wide{high_of(x)} * high_of(y) + high_of(left) + high_of(right) + high_of(middle);
  if (down < 64) return {top >> down, (low_of(middle) >> down) | (low_of(top) << (64 - down))};
  return {down < 128 ? top >> down : 0, low_of(top >> (down - 64))};
}

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
  // Products are in units of 2^-184 of what is above them all, so that 256 of them have room.
  constexpr unsigned room = 8, bits_kept = 192, least = Bits::bias + 256,
                     highest = Bits::bias + Bits::exponent_mask - 32;
  if (greatest > 0 && (greatest < least || greatest > highest)) return false;
  Sum sum;
  for (long i = 0; i < n; ++i) {
    const Bits a = bits(x, i * x_stride), b = bits(y, i * y_stride);
    exponent_of_product(exponent, a, b);
    const unsigned down = greatest + room - exponent;
    if (exponent == 0 || down >= bits_kept) continue;
    sum.add(product_of(a, b, down), -((a.high ^ b.high) >> 63));
  }
  const std::uint64_t sign = sum.negative() ? Bits::sign : 0;
  if (sign != 0) sum.negate();
  Bits result{0, 0};
  if (sum.high != 0 || sum.low != 0) {
    const int zeros = sum.high != 0 ? leading_zeros(sum.high) : 128 + std::countl_zero(sum.low);
    Wide leading = 0;
    if (zeros == 0)
      leading = sum.high | (sum.low != 0);
    else if (zeros < 64)
      leading = (sum.high << zeros) | (sum.low >> (64 - zeros)) | (sum.low << zeros != 0);
    else
      leading = wide(low_of(sum.high), sum.low) << (zeros - 64);
    result = rounded(leading, greatest + room + 1 - Bits::bias - static_cast<unsigned>(zeros), sign);
  }
  set_bits(r.backend().value(), result);
  return true;
}

}  // namespace hbvm::core

#endif
