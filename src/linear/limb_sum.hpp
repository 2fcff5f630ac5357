#pragma once

#include <mpfr.h>

#include <algorithm>

#include "linear/limbs.hpp"

namespace hbvm::core {

/// From about this length on mpfr_mul, which computes the upper half of a product alone, is as fast as sums of whole
/// products.
inline constexpr long max_limbs = 24;

inline long limbs_of(mpfr_srcptr x) { return (mpfr_get_prec(x) + limb_bits - 1) / limb_bits; }

/// to = the highest `taken` <= limbs_of(x) limbs of x, which is not 0.
inline void copy_highest_limbs(Limb* to, mpfr_srcptr x, long taken) {
  const long own = (mpfr_get_prec(x) + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS, wanted = taken * limb_parts;
  const auto* const digits = static_cast<const mp_limb_t*>(mpfr_custom_get_significand(x));
  // Of short limbs one may be missing at the lower end.
  const long missing = std::max(wanted - own, 0L);
  std::fill_n(parts_of(to), missing, mp_limb_t{0});
  std::copy_n(digits + own - (wanted - missing), wanted - missing, parts_of(to) + missing);
}

/// The limbs of a number that is not 0, lowest first; in `room` if the number itself has other ones.
inline const Limb* digits_of(mpfr_srcptr x, Limb* room) {
  if constexpr (limb_parts == 1) return static_cast<const Limb*>(mpfr_custom_get_significand(x));
  copy_highest_limbs(room, x, limbs_of(x));
  return room;
}

/// to = |x| / 2^exponent < 1, cut to so many limbs, from the lowest on; 0 if x is no number.
inline void set_limbs(Limb* to, long limbs, mpfr_srcptr x, long exponent) {
  std::fill_n(to, limbs, Limb{0});
  if (!mpfr_regular_p(x)) return;
  const long down = exponent - mpfr_get_exp(x), kept = limbs - down / limb_bits;
  if (kept <= 0) return;
  // The highest limbs: of x all, or as many as are kept.
  const long taken = std::min(limbs_of(x), kept);
  copy_highest_limbs(to + kept - taken, x, taken);
  if (const auto bits = static_cast<unsigned>(down % limb_bits); bits != 0) shift_limbs_down(to, to, kept, bits);
}

/// r = sum 2^(exponent - b (width - 1)) rounded once, for a sum of `width` limbs of b bits in two's complement, lowest
/// first. Its limbs are overwritten.
void set_limb_sum(mpfr_ptr r, Limb* sum, long width, mpfr_exp_t exponent);

}  // namespace hbvm::core
