#pragma once

#include <gmp.h>

#include <bit>
#include <cstdint>

namespace hbvm::core {

/// A piece of 64 bits of a whole number, lowest first. Those of the library are as long on most processors and half as
/// long in a browser. What is left out of a product, and so every digit, is the same on both.
using Limb = std::uint64_t;
inline constexpr long limb_bits = 64;
static_assert(std::endian::native == std::endian::little && limb_bits % GMP_NUMB_BITS == 0,
              "two short limbs would not stand in memory like a long one");
/// How many of the library's a limb is.
inline constexpr long limb_parts = limb_bits / GMP_NUMB_BITS;

inline mp_limb_t* parts_of(Limb* x) { return reinterpret_cast<mp_limb_t*>(x); }
inline const mp_limb_t* parts_of(const Limb* x) { return reinterpret_cast<const mp_limb_t*>(x); }

/// r = x y, of 2 n limbs.
inline void multiply_limbs(Limb* r, const Limb* x, const Limb* y, long n) {
  mpn_mul_n(parts_of(r), parts_of(x), parts_of(y), limb_parts * n);
}
/// r += x, of n limbs and `length` <= n.
inline void add_limbs(Limb* r, long n, const Limb* x, long length) {
  mpn_add(parts_of(r), parts_of(r), limb_parts * n, parts_of(x), limb_parts * length);
}
/// r -= x, likewise.
inline void subtract_limbs(Limb* r, long n, const Limb* x, long length) {
  mpn_sub(parts_of(r), parts_of(r), limb_parts * n, parts_of(x), limb_parts * length);
}
/// x = -x in two's complement.
inline void negate_limbs(Limb* x, long n) { mpn_neg(parts_of(x), parts_of(x), limb_parts * n); }

/// to = x / 2^bits, cut, for 0 < bits < 64; `to` may be x.
inline void shift_limbs_down(Limb* to, const Limb* x, long n, unsigned bits) {
  if constexpr (limb_parts == 1) {
    mpn_rshift(parts_of(to), parts_of(x), n, bits);
  } else {
    for (long i = 0; i < n; ++i) to[i] = x[i] >> bits | (i + 1 < n ? x[i + 1] << (limb_bits - bits) : 0);
  }
}
/// x = 2^bits x, for 0 < bits < 64.
inline void shift_limbs_up(Limb* x, long n, unsigned bits) {
  if constexpr (limb_parts == 1) {
    mpn_lshift(parts_of(x), parts_of(x), n, bits);
  } else {
    for (long i = n - 1; i >= 0; --i) x[i] = x[i] << bits | (i > 0 ? x[i - 1] >> (limb_bits - bits) : 0);
  }
}

}  // namespace hbvm::core
