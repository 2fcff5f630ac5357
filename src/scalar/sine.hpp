#pragma once

#include <mpfr.h>

namespace hbvm::core {

/// r = sin a and r = cos a, rounded to nearest. The bits are those that mpfr_sin and mpfr_cos give, in a third to a
/// half of their time. They are called themselves where the ball of the value does not decide the last bit. r may be a;
/// the direction, which is there as MPFR has it, must be MPFR_RNDN.
void set_sin(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);
void set_cos(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);

}  // namespace hbvm::core
