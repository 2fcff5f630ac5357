#pragma once

#include "scalar/arb.hpp"
#include "scalar/big_float.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Numbers of FLINT/Arb, which hold the exact result, in the bits of the BallScope.

/// The radius, from above.
inline BigFloat radius_of(const RealBall& x) {
  arf_t exact;
  arf_init(exact);
  arf_set_mag(exact, arb_radref(raw(x)));
  BigFloat result(64);
  arf_get_mpfr(raw(result), exact, MPFR_RNDU);
  arf_clear(exact);
  return result;
}
/// The midpoint, with all its bits.
inline BigFloat midpoint_of(const RealBall& x) {
  BigFloat result(static_cast<mpfr_prec_t>(BallScope::bits()));
  arf_get_mpfr(raw(result), arb_midref(raw(x)), MPFR_RNDN);
  return result;
}

inline RealBall made(void (*f)(arb_t, const arb_t, const arb_t, slong), const RealBall& a, const RealBall& b) {
  RealBall result;
  f(raw(result), raw(a), raw(b), BallScope::bits());
  return result;
}
inline RealBall made(void (*f)(arb_t, const arb_t, slong), const RealBall& a) {
  RealBall result;
  f(raw(result), raw(a), BallScope::bits());
  return result;
}

inline RealBall pow(const RealBall& a, const RealBall& b) { return made(arb_pow, a, b); }
inline RealBall sqrt(const RealBall& a) { return made(arb_sqrt, a); }
inline RealBall sin(const RealBall& a) { return made(arb_sin, a); }
inline RealBall cos(const RealBall& a) { return made(arb_cos, a); }
inline RealBall tan(const RealBall& a) { return made(arb_tan, a); }
inline RealBall exp(const RealBall& a) { return made(arb_exp, a); }
inline RealBall log(const RealBall& a) { return made(arb_log, a); }
inline RealBall sinh(const RealBall& a) { return made(arb_sinh, a); }
inline RealBall cosh(const RealBall& a) { return made(arb_cosh, a); }
inline RealBall tanh(const RealBall& a) { return made(arb_tanh, a); }
inline RealBall asin(const RealBall& a) { return made(arb_asin, a); }
inline RealBall acos(const RealBall& a) { return made(arb_acos, a); }
inline RealBall atan(const RealBall& a) { return made(arb_atan, a); }
inline RealBall atan2(const RealBall& y, const RealBall& x) { return made(arb_atan2, y, x); }

}  // namespace hbvm::core
