#include "linear/limb_sum.hpp"

namespace hbvm::core {

void set_limb_sum(mpfr_ptr r, mp_limb_t* sum, long width, mpfr_exp_t exponent) {
  const bool negative = sum[width - 1] >> (limb_bits - 1) != 0;
  if (negative) mpn_neg(sum, sum, width);
  long used = width;
  while (used > 0 && sum[used - 1] == 0) --used;
  if (used == 0) {
    mpfr_set_zero(r, 1);
    return;
  }
  const auto leading = static_cast<unsigned>(__builtin_clzl(sum[used - 1]));
  if (leading != 0) mpn_lshift(sum, sum, used, leading);
  mpfr_t view;
  mpfr_custom_init_set(view, negative ? -MPFR_REGULAR_KIND : MPFR_REGULAR_KIND,
                       exponent - limb_bits * (width - 1 - used) - static_cast<long>(leading), used * limb_bits, sum);
  mpfr_set(r, view, MPFR_RNDN);
}

}  // namespace hbvm::core
