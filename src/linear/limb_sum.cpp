#include "linear/limb_sum.hpp"

#include <bit>

namespace hbvm::core {

void set_limb_sum(mpfr_ptr r, Limb* sum, long width, mpfr_exp_t exponent) {
  const bool negative = sum[width - 1] >> (limb_bits - 1) != 0;
  if (negative) negate_limbs(sum, width);
  long used = width;
  while (used > 0 && sum[used - 1] == 0) --used;
  if (used == 0) {
    mpfr_set_zero(r, 1);
    return;
  }
  const auto leading = static_cast<unsigned>(std::countl_zero(sum[used - 1]));
  if (leading != 0) shift_limbs_up(sum, used, leading);
  mpfr_t view;
  mpfr_custom_init_set(view, negative ? -MPFR_REGULAR_KIND : MPFR_REGULAR_KIND,
                       exponent - limb_bits * (width - 1 - used) - static_cast<long>(leading), used * limb_bits, sum);
  mpfr_set(r, view, MPFR_RNDN);
}

}  // namespace hbvm::core
