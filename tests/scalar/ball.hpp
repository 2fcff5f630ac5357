#pragma once

#include <arb.h>

#include "hbvm/scalar/big_float.hpp"
#include "hbvm/scalar/scalar.hpp"

namespace hbvm {

/// A number of FLINT/Arb, an interval that holds the exact result, in the bits of `bits`.
class Ball {
 public:
  static inline slong bits = 128;

  Ball() { arb_init(x_); }
  Ball(int n) : Ball() { arb_set_si(x_, n); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

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

  friend Ball operator+(const Ball& a, const Ball& b) { return made(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return made(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return made(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return made(arb_div, a, b); }
  friend Ball operator-(const Ball& a) { return Ball(0) - a; }
  friend Ball pow(const Ball& a, const Ball& b) { return made(arb_pow, a, b); }
  friend Ball sqrt(const Ball& a) { return made(arb_sqrt, a); }
  friend Ball sin(const Ball& a) { return made(arb_sin, a); }
  friend Ball cos(const Ball& a) { return made(arb_cos, a); }
  friend Ball tan(const Ball& a) { return made(arb_tan, a); }
  friend Ball exp(const Ball& a) { return made(arb_exp, a); }
  friend Ball log(const Ball& a) { return made(arb_log, a); }
  friend Ball sinh(const Ball& a) { return made(arb_sinh, a); }
  friend Ball cosh(const Ball& a) { return made(arb_cosh, a); }
  friend Ball tanh(const Ball& a) { return made(arb_tanh, a); }
  friend Ball atan(const Ball& a) { return made(arb_atan, a); }

 private:
  static Ball made(void (*f)(arb_t, const arb_t, const arb_t, slong), const Ball& a, const Ball& b) {
    Ball result;
    f(result.x_, a.x_, b.x_, bits);
    return result;
  }
  static Ball made(void (*f)(arb_t, const arb_t, slong), const Ball& a) {
    Ball result;
    f(result.x_, a.x_, bits);
    return result;
  }

  arb_t x_;
};

}  // namespace hbvm
