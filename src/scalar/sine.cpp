#include "scalar/sine.hpp"

#include "scalar/arb.hpp"

namespace hbvm::core {
namespace {

/// \returns whether r = f(a), rounded to nearest, is known
bool set_by_ball(mpfr_ptr r, mpfr_srcptr a, void (*f)(arb_t, const arb_t, slong)) {
  if (mpfr_regular_p(a) == 0) return false;
  // With so many more bits a rounding is unknown about once in 2^19 times.
  constexpr slong guard_bits = 20;
  thread_local RealBall argument, value;  // of zero radius, and not
  arf_set_mpfr(arb_midref(raw(argument)), a);
  const slong bits = mpfr_get_prec(r);
  f(raw(value), raw(argument), bits + guard_bits);
  if (arb_can_round_mpfr(raw(value), bits, MPFR_RNDN) == 0) return false;
  arf_get_mpfr(r, arb_midref(raw(value)), MPFR_RNDN);
  return true;
}

void set_rounded(mpfr_ptr r, mpfr_srcptr a, void (*ball)(arb_t, const arb_t, slong),
                 int (*rounded)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)) {
  if (!has_sine_in_reach(a)) return mpfr_set_nan(r);
  if (!set_by_ball(r, a, ball)) rounded(r, a, MPFR_RNDN);
}

}  // namespace

bool has_sine_in_reach(mpfr_srcptr a) {
  constexpr mpfr_exp_t greatest = 131072;
  return mpfr_regular_p(a) == 0 || mpfr_get_exp(a) <= greatest;
}

void set_sin(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t) { set_rounded(r, a, arb_sin, mpfr_sin); }

void set_cos(mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t) { set_rounded(r, a, arb_cos, mpfr_cos); }

}  // namespace hbvm::core
