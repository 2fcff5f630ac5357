#pragma once

#include <gmp.h>
#include <mpfr.h>

#include <algorithm>

namespace hbvm::core {

inline constexpr long limb_bits = GMP_NUMB_BITS;
/// From about this length on mpfr_mul, which computes the upper half of a product alone, is as fast as sums of whole
/// products.
inline constexpr long max_limbs = 24;

/// The limbs of a number that is not 0, lowest first, and how many they are.
inline const mp_limb_t* digits_of(mpfr_srcptr x) {
  return static_cast<const mp_limb_t*>(mpfr_custom_get_significand(x));
}
inline long limbs_of(mpfr_srcptr x) { return (mpfr_get_prec(x) + limb_bits - 1) / limb_bits; }

/// to = |x| / 2^exponent < 1, cut to so many limbs, from the lowest on; 0 if x is no number.
inline void set_limbs(mp_limb_t* to, long limbs, mpfr_srcptr x, long exponent) {
  std::fill_n(to, limbs, mp_limb_t{0});
  if (!mpfr_regular_p(x)) return;
  const long down = exponent - mpfr_get_exp(x), kept = limbs - down / limb_bits, own = limbs_of(x);
  if (kept <= 0) return;
  // The highest limbs: of x all, or as many as are kept.
  const long taken = std::min(own, kept);
  std::copy_n(digits_of(x) + own - taken, taken, to + kept - taken);
  if (const auto bits = static_cast<unsigned>(down % limb_bits); bits != 0) mpn_rshift(to, to, kept, bits);
}

/// r = sum 2^(exponent - b (width - 1)) rounded once, for a sum of `width` limbs of b bits in two's complement, lowest
/// first. Its limbs are overwritten.
void set_limb_sum(mpfr_ptr r, mp_limb_t* sum, long width, mpfr_exp_t exponent);

}  // namespace hbvm::core
