#pragma once

#include <mpfr.h>

namespace hbvm::core {

/// r = sin a and r = cos a, rounded to nearest: the same bits as mpfr_sin and mpfr_cos give, in a quarter to a half of
/// their time. They are called themselves where the table does not reach, which is for 2^-20 < |a| < 2^20 and to 200
/// digits, or does not decide the last bit. r may be a; the direction, which is there as MPFR has it, must be
/// MPFR_RNDN.
void set_sin(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);
void set_cos(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);

}  // namespace hbvm::core
