#pragma once

#include <mpfr.h>

namespace hbvm::core {

/// r = sin a and r = cos a, rounded to nearest. The bits are those that mpfr_sin and mpfr_cos give, in a quarter
/// to a half of their time. They are called themselves where the ball of the value does not decide the last bit. NaN if
/// a has no sine in reach. r may be a; the direction, which is there as MPFR has it, must be MPFR_RNDN.
void set_sin(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);
void set_cos(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t = MPFR_RNDN);

/// Whether |a| < 2^131072, about 10^39456, eight times the exponents of quad. The reduction by pi takes as many bits as
/// the exponent of a says. An iteration that diverges squares its numbers in each sweep, and would never end.
bool has_sine_in_reach(mpfr_srcptr a);

}  // namespace hbvm::core
