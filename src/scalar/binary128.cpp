#include "scalar/binary128.hpp"

#include <array>
#include <cmath>

namespace hbvm::core::binary128 {
namespace {

__extension__ using Signed = __int128;

/// x^2 cut by 2^64, modulo 2^128.
Wide square_without_lowest(Wide x) {
  const std::uint64_t high = high_of(x), low = low_of(x);
  return (Wide{high} * high << 64) + (Wide{high} * low << 1) + high_of(Wide{low} * low);
}

/// |x| y / 2^(64 + shift), cut, with the sign of x.
Wide scaled_product(Signed x, std::uint64_t y, int shift) {
  const Wide size = static_cast<Wide>(x < 0 ? -x : x);
  const Wide product = (Wide{high_of(size)} * y + high_of(Wide{low_of(size)} * y)) >> shift;
  return x < 0 ? -product : product;
}

/// 2^128 / n! for n = 2, 4, 6, ... or 3, 5, 7, ...
constexpr std::size_t terms = 16;
constexpr std::array<Wide, terms> reciprocal_factorials(unsigned first) {
  std::array<Wide, terms> c{};
  Wide term = Wide{1} << 127;  // 1/2!
  if (first == 3) term = ~Wide{0} / 6;
  for (std::size_t j = 0; j < terms; ++j) {
    c[j] = term;
    const auto n = first + 2 * static_cast<unsigned>(j);
    term /= (n + 1) * (n + 2);
  }
  return c;
}

/// z (c_0 - z (c_1 - z (c_2 - ...))) in units of 2^-128, for z < 0.62.
Wide alternating_series(const std::array<Wide, terms>& c, Wide z) {
  constexpr std::size_t short_from = 10;  // 22! > 2^64
  std::uint64_t tail = low_of(c[terms - 1]);
  for (std::size_t j = terms - 1; j-- > short_from;) tail = low_of(c[j]) - high_of(Wide{tail} * high_of(z));
  Wide sum = tail;
  for (std::size_t j = short_from; j-- > 0;) sum = c[j] - high_product(sum, z);
  return high_product(sum, z);
}

Wide cosine_series(Wide z) {
  static constexpr std::array<Wide, terms> c = reciprocal_factorials(2);
  return alternating_series(c, z);
}
Wide sine_series(Wide z) {
  static constexpr std::array<Wide, terms> c = reciprocal_factorials(3);
  return alternating_series(c, z);
}

/// |a| = quarters pi/2 + r.
struct Angle {
  bool own;  ///< r = |a|
  unsigned quarters;
  bool negative;  ///< r < 0
  Wide size;      ///< |r| in units of 2^-128
};

bool reduce(Angle& angle, const Bits& a) {
  constexpr unsigned least = Bits::bias - 100, most = Bits::bias + 30;
  const unsigned exponent = a.exponent();
  if (exponent < least || exponent >= most) return false;
  const Wide significand = wide(a.significand_high(), a.low);
  const int whole = static_cast<int>(exponent) - static_cast<int>(Bits::bias);
  // In units of 2^-127, modulo 2: r is within a quarter of a turn.
  const int shift = whole + 15;
  const Wide x = shift >= 0 ? significand << shift : significand >> -shift;
  // pi/2 in the same units, and 64 bits more.
  constexpr Wide pi_fraction = (Wide{0x243f6a8885a308d3} << 64) | 0x13198a2e03707344;
  constexpr Wide quarter = (Wide{3} << 126) | (pi_fraction >> 2);
  constexpr std::uint64_t quarter_rest = (static_cast<std::uint64_t>(pi_fraction) << 62) | (0xa4093822299f31d0 >> 2);
  constexpr std::uint64_t quarters_a_unit = 0xa2f9836e4e441529;  // 2/pi in units of 2^-64
  // |a| 2/pi, rounded to the nearest whole number, by the first 64 bits of a.
  const std::uint64_t leading = (a.significand_high() << 15) | (a.low >> 49);
  const std::uint64_t product = high_of(Wide{leading} * quarters_a_unit);  // a 2/pi 2^(63 - whole)
  const int places = 63 - whole;
  const std::uint64_t n = places > 64 ? 0 : places == 64 ? product >> 63 : ((product >> (places - 1)) + 1) >> 1;
  const Wide away = n * quarter + high_of(Wide{n} * quarter_rest);
  const auto r = static_cast<Signed>(x - away);
  angle = {n == 0, static_cast<unsigned>(n & 3), r < 0, static_cast<Wide>(r < 0 ? -r : r) << 1};
  return true;
}

/// x > 0 in units of 2^-128, rounded.
Bits fraction(Wide x, std::uint64_t sign) {
  const int zeros = leading_zeros(x);
  return rounded(x << zeros, Bits::bias - 1 - static_cast<unsigned>(zeros), sign);
}

/// r = sin(quarters pi/2 + r of the angle), with the other sign if `negative`. \return false where too few bits are
/// left of it
bool take_sine(Bits& r, const Angle& angle, unsigned quarters, bool negative) {
  const Wide square = high_product(angle.size, angle.size);
  const bool of_cosine = quarters % 2 != 0;
  const Wide size = of_cosine ? -cosine_series(square) : angle.size - high_product(angle.size, sine_series(square));
  constexpr int least_bits = 8;
  if (high_of(size) >> (64 - least_bits) == 0) return false;
  const bool changes = (quarters & 2) != 0, below = !of_cosine && angle.negative;
  r = fraction(size, negative != (changes != below) ? Bits::sign : 0);
  return true;
}

/// a - a times what the series takes away, which is small and needs few bits.
bool take_small_sine(Bits& r, const Angle& angle, const Bits& a) {
  const Wide lost = sine_series(high_product(angle.size, angle.size));
  if (lost == 0) {
    r = a;
    return true;
  }
  Bits product;
  return multiply(product, a, fraction(lost, 0)) && add(r, a, product, Bits::sign);
}

}  // namespace

bool square_root(Bits& r, const Bits& a) {
  if (!a.normal() || a.high >> 63 != 0) return false;
  const unsigned odd = (a.exponent() + 1) & 1;
  // x / 2^126 is in [1, 4); y / 2^64 its root's reciprocal to 50 bits.
  const Wide x = wide(a.significand_high(), a.low) << (14 + odd);
  constexpr auto two_to_51 = static_cast<double>(std::uint64_t{1} << 51);
  const double reciprocal = 1 / std::sqrt(static_cast<double>(high_of(x) >> 11) / two_to_51);
  const std::uint64_t y =
      reciprocal < 1 ? static_cast<std::uint64_t>(4 * two_to_51 * reciprocal) << 11 : ~std::uint64_t{0} << 11;
  // The root in units of 2^-126, and two corrections (x - root^2) / (2 root).
  Wide root = Wide{high_of(x)} * y + high_of(Wide{low_of(x)} * y);
  const std::uint64_t high = high_of(root), low = low_of(root);
  const Wide coarse = (Wide{high} * high << 32) + (Wide{high} * low >> 31) + (Wide{low} * low >> 96);
  root += scaled_product(static_cast<Signed>((x << 30) - coarse), y, 31);
  root += scaled_product(static_cast<Signed>((x << 62) - square_without_lowest(root)), y, 63);
  // It has an error of a few units. Where they matter to the rounding, the place halfway decides, squared.
  constexpr std::uint64_t half = 1 << 13, few = 8;
  if ((low_of(root) & (2 * half - 1)) - (half - few) < 2 * few) {
    const Wide halfway = (root & ~Wide{2 * half - 1}) | half;
    root = static_cast<Signed>((x << 62) - square_without_lowest(halfway)) > 0 ? halfway + 1 : halfway - 1;
  }
  r = rounded(root << 1, (a.exponent() + Bits::bias - odd) / 2, 0);
  return true;
}

bool cosine(Bits& r, const Bits& a) {
  Angle angle;
  return reduce(angle, a) && take_sine(r, angle, angle.quarters + 1, false);
}

bool sine(Bits& r, const Bits& a) {
  Angle angle;
  return reduce(angle, a) &&
         (take_sine(r, angle, angle.quarters, a.high >> 63 != 0) || (angle.own && take_small_sine(r, angle, a)));
}

}  // namespace hbvm::core::binary128
