#pragma once

#include "scalar/arb.hpp"
#include "scalar/big_float.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// A number of FLINT/Arb, an interval that holds the exact result, in the bits of `bits`.
class RealBall {
 public:
  static inline slong bits = 128;

  RealBall() { arb_init(x_); }
  RealBall(int n) : RealBall() { arb_set_si(x_, n); }
  RealBall(const RealBall& other) : RealBall() { arb_set(x_, other.x_); }
  RealBall& operator=(const RealBall& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  ~RealBall() { arb_clear(x_); }

  /// The radius, from above.
  BigFloat radius() const {
    arf_t exact;
    arf_init(exact);
    arf_set_mag(exact, arb_radref(x_));
    BigFloat result(64);
    arf_get_mpfr(raw(result), exact, MPFR_RNDU);
    arf_clear(exact);
    return result;
  }
  /// The midpoint, with all its bits.
  BigFloat midpoint() const {
    BigFloat result(static_cast<mpfr_prec_t>(bits));
    arf_get_mpfr(raw(result), arb_midref(x_), MPFR_RNDN);
    return result;
  }

  friend RealBall operator+(const RealBall& a, const RealBall& b) { return made(arb_add, a, b); }
  friend RealBall operator-(const RealBall& a, const RealBall& b) { return made(arb_sub, a, b); }
  friend RealBall operator*(const RealBall& a, const RealBall& b) { return made(arb_mul, a, b); }
  friend RealBall operator/(const RealBall& a, const RealBall& b) { return made(arb_div, a, b); }
  friend RealBall operator-(const RealBall& a) { return RealBall(0) - a; }
  friend RealBall pow(const RealBall& a, const RealBall& b) { return made(arb_pow, a, b); }
  friend RealBall sqrt(const RealBall& a) { return made(arb_sqrt, a); }
  friend RealBall sin(const RealBall& a) { return made(arb_sin, a); }
  friend RealBall cos(const RealBall& a) { return made(arb_cos, a); }
  friend RealBall tan(const RealBall& a) { return made(arb_tan, a); }
  friend RealBall exp(const RealBall& a) { return made(arb_exp, a); }
  friend RealBall log(const RealBall& a) { return made(arb_log, a); }
  friend RealBall sinh(const RealBall& a) { return made(arb_sinh, a); }
  friend RealBall cosh(const RealBall& a) { return made(arb_cosh, a); }
  friend RealBall tanh(const RealBall& a) { return made(arb_tanh, a); }
  friend RealBall atan(const RealBall& a) { return made(arb_atan, a); }

 private:
  static RealBall made(void (*f)(arb_t, const arb_t, const arb_t, slong), const RealBall& a, const RealBall& b) {
    RealBall result;
    f(result.x_, a.x_, b.x_, bits);
    return result;
  }
  static RealBall made(void (*f)(arb_t, const arb_t, slong), const RealBall& a) {
    RealBall result;
    f(result.x_, a.x_, bits);
    return result;
  }

  arb_t x_;
};

}  // namespace hbvm::core
