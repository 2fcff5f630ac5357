#include "linear/mpfr_dot.hpp"

#include <algorithm>
#include <limits>

#include "linear/limb_sum.hpp"

namespace hbvm::core {

bool dot(mpfr_ptr r, const Mpfr* x, long x_stride, const Mpfr* y, long y_stride, long n) {
  const long limbs = limbs_of(r);
  if (limbs > max_limbs) return false;

  // A number is 0.d1d2… 2^exponent with its first bit set: the largest exponent of a product is that of the sum's unit.
  constexpr mpfr_exp_t none = std::numeric_limits<mpfr_exp_t>::min();
  mpfr_exp_t largest = none;
  for (long i = 0; i < n; ++i) {
    mpfr_srcptr const a = raw(x[i * x_stride]);
    mpfr_srcptr const b = raw(y[i * y_stride]);
    if (limbs_of(a) != limbs || limbs_of(b) != limbs || !mpfr_number_p(a) || !mpfr_number_p(b)) return false;
    if (mpfr_zero_p(a) || mpfr_zero_p(b)) continue;
    largest = std::max(largest, mpfr_get_exp(a) + mpfr_get_exp(b));
  }
  if (largest == none) {
    mpfr_set_zero(r, 1);
    return true;
  }

  // The sum in two's complement: a limb below the last of a product's upper half, and one above for sign and carries.
  const long width = limbs + 2;
  Limb sum[max_limbs + 2], product[2 * max_limbs], shifted[max_limbs + 1], rooms[2][max_limbs];
  std::fill_n(sum, width, Limb{0});
  for (long i = 0; i < n; ++i) {
    mpfr_srcptr const a = raw(x[i * x_stride]);
    mpfr_srcptr const b = raw(y[i * y_stride]);
    if (mpfr_zero_p(a) || mpfr_zero_p(b)) continue;
    const mpfr_exp_t down = largest - mpfr_get_exp(a) - mpfr_get_exp(b);
    const long whole = static_cast<long>(down / limb_bits);
    if (whole > limbs) continue;  // below the last limb
    multiply_limbs(product, digits_of(a, rooms[0]), digits_of(b, rooms[1]), limbs);
    const long kept = limbs + 1 - whole;
    const Limb* top = product + 2 * limbs - kept;
    if (const auto bits = static_cast<unsigned>(down % limb_bits); bits != 0) {
      shift_limbs_down(shifted, top, kept, bits);
      top = shifted;
    }
    if ((mpfr_signbit(a) != 0) == (mpfr_signbit(b) != 0))
      add_limbs(sum, width, top, kept);
    else
      subtract_limbs(sum, width, top, kept);
  }

  set_limb_sum(r, sum, width, largest);
  return true;
}

}  // namespace hbvm::core
