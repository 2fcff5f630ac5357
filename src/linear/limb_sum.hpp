#pragma once

#include <gmp.h>
#include <mpfr.h>

namespace hbvm::core {

inline constexpr long limb_bits = GMP_NUMB_BITS;
/// From about this length on mpfr_mul, which computes the upper half of a product alone, is as fast as sums of whole
/// products.
inline constexpr long max_limbs = 24;

/// r = sum 2^(exponent - b (width - 1)) rounded once, for a sum of `width` limbs of b bits in two's complement, lowest
/// first. Its limbs are overwritten.
void set_limb_sum(mpfr_ptr r, mp_limb_t* sum, long width, mpfr_exp_t exponent);

}  // namespace hbvm::core
