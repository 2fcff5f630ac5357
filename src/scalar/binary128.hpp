#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace hbvm::core::binary128 {

/// The bits of an IEEE binary128 number. They are a sign, 15 bits of an exponent biased by 16383, and 112 bits of a
/// significand whose leading bit is not written.
///
/// Compilers leave its arithmetic to a library, whose calls read the processor's rounding mode and raise its flags.
/// The functions below do it in whole numbers and inline, rounded to nearest, ties to even. Where they return true, a
/// sum and a product have the library's bits. Where they return false, the result is left alone, and the library has
/// to do it. An operand or the result is subnormal, infinite or NaN then, or close to the ends of the exponents.
struct Bits {
  std::uint64_t low, high;

  static constexpr unsigned exponent_mask = 0x7fff, bias = 0x3fff;
  static constexpr std::uint64_t sign = std::uint64_t{1} << 63, lead = std::uint64_t{1} << 48;

  unsigned exponent() const { return static_cast<unsigned>(high >> 48) & exponent_mask; }
  bool zero() const { return (high << 1 | low) == 0; }
  bool finite() const { return exponent() != exponent_mask; }
  /// Neither 0 nor subnormal, infinite or NaN.
  bool normal() const { return exponent() - 1 < exponent_mask - 1; }
  Bits magnitude() const { return {low, high & ~sign}; }
  /// The higher half of the significand.
  std::uint64_t significand_high() const { return (high & (lead - 1)) | lead; }
};

/// Of a T of 16 bytes that holds such a number, and the other way round.
template <class T>
Bits bits_of(const T& x) {
  static_assert(sizeof(T) == sizeof(Bits));
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
template <class T>
void set_bits(T& x, const Bits& bits) {
  static_assert(sizeof(T) == sizeof(Bits));
  std::memcpy(&x, &bits, sizeof bits);
}

__extension__ using Wide = unsigned __int128;
inline std::uint64_t high_of(Wide x) { return static_cast<std::uint64_t>(x >> 64); }
inline std::uint64_t low_of(Wide x) { return static_cast<std::uint64_t>(x); }
inline Wide wide(std::uint64_t high, std::uint64_t low) { return (Wide{high} << 64) | low; }
/// Zeros before the leading bit of x > 0.
inline int leading_zeros(Wide x) {
  return high_of(x) != 0 ? std::countl_zero(high_of(x)) : 64 + std::countl_zero(low_of(x));
}
/// The first 128 of the 256 bits of a b, less at most 2.
inline Wide high_product(Wide a, Wide b) {
  return Wide{high_of(a)} * high_of(b) + high_of(Wide{high_of(a)} * low_of(b)) + high_of(Wide{low_of(a)} * high_of(b));
}

/// Rounds x, whose leading bit is its highest, to a significand. Joins it with the exponent of that bit, and with the
/// sign in the highest bit of `signed_by`.
inline Bits rounded(Wide x, unsigned exponent, std::uint64_t signed_by) {
  constexpr int cut = 15;
  // To half of the last place less one, and with an odd last place half of it: a carry rounds up.
  const std::uint64_t up = (std::uint64_t{1} << (cut - 1)) - 1 + ((low_of(x) >> cut) & 1);
  const std::uint64_t lost = low_of(x) & ((std::uint64_t{1} << cut) - 1);
  const Wide kept = (x >> cut) + ((lost + up) >> cut);
  // The leading bit, or the next if all were rounded up, adds to the exponent.
  return {low_of(kept), (high_of(kept) + (std::uint64_t{exponent - 1} << 48)) | (signed_by & Bits::sign)};
}

/// r = a b if one is 0 and the other is finite.
inline bool multiply_by_zero(Bits& r, const Bits& a, const Bits& b) {
  if (!a.finite() || !b.finite() || (!a.zero() && !b.zero())) return false;
  r = {0, (a.high ^ b.high) & Bits::sign};
  return true;
}

/// r = a b.
[[gnu::always_inline]] inline bool multiply(Bits& r, const Bits& a, const Bits& b) {
  const unsigned exponent = a.exponent() + b.exponent() - Bits::bias - 1;
  constexpr unsigned room = 16;
  if (!a.normal() || !b.normal() || exponent - 1 >= Bits::exponent_mask - room) [[unlikely]]
    return multiply_by_zero(r, a, b);
  const std::uint64_t a1 = a.significand_high(), a0 = a.low;
  // 2^15 b, so that the product ends 128 places below the significand.
  const std::uint64_t b1 = (b.significand_high() << 15) | (b.low >> 49), b0 = b.low << 15;
  const Wide lowest = Wide{a0} * b0, left = Wide{a0} * b1;
  const Wide middle = Wide{a1} * b0 + high_of(lowest) + low_of(left);
  Wide top = Wide{a1} * b1 + high_of(left) + high_of(middle);
  std::uint64_t rest = low_of(middle) | (low_of(lowest) != 0);
  // Of a product below 2 twice as much, without a branch: which it is, is chance.
  const auto big = static_cast<unsigned>(high_of(top) >> 48);
  const std::uint64_t small = std::uint64_t{big} - 1;
  const std::uint64_t carried = (rest & small) >> 63;
  rest += rest & small;
  top += (top & wide(small, small)) + carried;
  const std::uint64_t up = rest + (Bits::sign - 1 + (low_of(top) & 1));
  top += up < rest;
  r = {low_of(top), (high_of(top) + (std::uint64_t{exponent + big} << 48)) | ((a.high ^ b.high) & Bits::sign)};
  return true;
}

/// r = a + b, or with the sign bit in `flip` a - b.
[[gnu::always_inline]] inline bool add(Bits& r, Bits a, Bits b, std::uint64_t flip = 0) {
  constexpr unsigned least_sum = 128;
  b.high ^= flip;
  {  // |a| >= |b|, without a branch
    const std::uint64_t swap = -std::uint64_t{(wide(a.high, a.low) << 1) < (wide(b.high, b.low) << 1)};
    const std::uint64_t high = (a.high ^ b.high) & swap, low = (a.low ^ b.low) & swap;
    a = {a.low ^ low, a.high ^ high};
    b = {b.low ^ low, b.high ^ high};
  }
  unsigned exponent = a.exponent();
  if (exponent - least_sum >= Bits::exponent_mask - 1 - least_sum) return false;
  if (b.exponent() == 0) [[unlikely]] {
    if (!b.zero()) return false;
    r = a;
    return true;
  }
  const unsigned distance = exponent - b.exponent();
  // The leading bit is that of 2^125; what is shifted out leaves its trace in the last bit.
  constexpr int guard = 13;
  const std::uint64_t a1 = (a.significand_high() << guard) | (a.low >> (64 - guard)), a0 = a.low << guard;
  std::uint64_t b1 = (b.significand_high() << guard) | (b.low >> (64 - guard)), b0 = b.low << guard;
  if (distance < 64) {
    const std::uint64_t lost = b0 << 1 << (63 - distance);
    b0 = (b0 >> distance) | (b1 << 1 << (63 - distance));
    b1 >>= distance;
    b0 |= lost != 0;
  } else if (distance < 128) {
    const std::uint64_t lost = b0 | (b1 << 1 << (127 - distance));
    b0 = (b1 >> (distance - 64)) | (lost != 0);
    b1 = 0;
  } else {
    r = a;
    return true;
  }
  const std::uint64_t negative = -((a.high ^ b.high) >> 63);
  Wide sum = wide(a1, a0) + wide(b1 ^ negative, b0 ^ negative) + (negative & 1);
  if (high_of(sum) < std::uint64_t{1} << 60) [[unlikely]] {
    if (sum == 0) {
      r = {0, 0};
      return true;
    }
    const int shift = leading_zeros(sum) - 2;
    sum <<= shift;
    exponent -= static_cast<unsigned>(shift);
  }
  const int zeros = std::countl_zero(high_of(sum));
  r = rounded(sum << zeros, exponent + 2 - static_cast<unsigned>(zeros), a.high);
  return true;
}

/// r = a 2^exponent.
inline bool scale(Bits& r, const Bits& a, long exponent) {
  const long sum = static_cast<long>(a.exponent()) + exponent;
  if (!a.normal() || sum < 1 || sum >= static_cast<long>(Bits::exponent_mask)) return false;
  r = {a.low, a.high + (static_cast<std::uint64_t>(exponent) << 48)};
  return true;
}

/// r = a, rounded.
inline bool to_double(double& r, const Bits& a) {
  constexpr unsigned cut = 60, double_bias = 1023, double_places = 52;
  const unsigned exponent = a.exponent() - Bits::bias + double_bias;
  if (!a.normal() || exponent - 1 >= 2 * double_bias - 2) return false;
  const Wide significand = wide(a.significand_high(), a.low);
  const std::uint64_t kept = low_of(significand >> cut), lost = a.low & ((std::uint64_t{1} << cut) - 1);
  const std::uint64_t up = (std::uint64_t{1} << (cut - 1)) - 1 + (kept & 1);
  const std::uint64_t bits = kept + ((lost + up) >> cut) + (std::uint64_t{exponent - 1} << double_places);
  const std::uint64_t with_sign = bits | (a.high & Bits::sign);
  std::memcpy(&r, &with_sign, sizeof r);
  return true;
}

/// Whether a = b and a < b, of any numbers: NaN is neither, and 0 is -0.
inline Wide size_of(const Bits& a) { return wide(a.magnitude().high, a.low); }
inline bool is_nan(const Bits& a) { return size_of(a) > wide(std::uint64_t{Bits::exponent_mask} << 48, 0); }
inline bool equal(const Bits& a, const Bits& b) {
  if (is_nan(a)) return false;
  return (a.low == b.low && a.high == b.high) || (size_of(a) | size_of(b)) == 0;
}
inline bool less(const Bits& a, const Bits& b) {
  if (is_nan(a) || is_nan(b)) return false;
  __extension__ using Signed = __int128;
  const auto value = [](const Bits& x) {
    const auto size = static_cast<Signed>(size_of(x));
    return (x.high & Bits::sign) != 0 ? -size : size;
  };
  return value(a) < value(b);
}

/// r = sqrt(a), correctly rounded.
bool square_root(Bits& r, const Bits& a);
/// r = sin(a) and r = cos(a), to 0.51 of the last place, for 2^-100 <= |a| < 2^30. Not where they are below 2^-8, but
/// for a sine with |a| < pi/4, which has 0.6 there.
bool sine(Bits& r, const Bits& a);
bool cosine(Bits& r, const Bits& a);

}  // namespace hbvm::core::binary128
