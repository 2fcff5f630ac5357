#pragma once

// Balls of Arb: a part of FLINT from its version 3 on, and a library beside it before.
#if __has_include(<flint/acb.h>)
#include <flint/acb.h>
#include <flint/arb_hypgeom.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#else
#include <acb.h>
#include <arb_hypgeom.h>
#include <arb_mat.h>
#include <arb_poly.h>
#endif

namespace hbvm::core {

/// For as long as it lives, operations on balls of this thread keep so many bits of a centre.
class BallScope {
 public:
  explicit BallScope(slong bits) : before_(bits_) { bits_ = bits; }
  ~BallScope() { bits_ = before_; }
  BallScope(const BallScope&) = delete;
  BallScope& operator=(const BallScope&) = delete;

  static slong bits() { return bits_; }

 private:
  slong before_;
  inline static thread_local slong bits_ = 64;
};

/// A real number between bounds: a centre and a radius about it. What an operator returns holds its result for all
/// numbers in its arguments, in the bits of the BallScope.
class RealBall {
 public:
  RealBall() { arb_init(value_); }
  RealBall(int whole) : RealBall() { arb_set_si(value_, whole); }
  RealBall(const RealBall& other) : RealBall() { arb_set(value_, other.value_); }
  RealBall(RealBall&& other) noexcept : RealBall() { arb_swap(value_, other.value_); }
  RealBall& operator=(RealBall other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~RealBall() { arb_clear(value_); }

  friend arb_ptr raw(RealBall& x) { return x.value_; }
  friend arb_srcptr raw(const RealBall& x) { return x.value_; }

  RealBall& operator+=(const RealBall& b) {
    arb_add(value_, value_, b.value_, BallScope::bits());
    return *this;
  }
  RealBall& operator-=(const RealBall& b) {
    arb_sub(value_, value_, b.value_, BallScope::bits());
    return *this;
  }
  void add_product(const RealBall& a, const RealBall& b) { arb_addmul(value_, a.value_, b.value_, BallScope::bits()); }

  bool is_finite() const { return arb_is_finite(value_) != 0; }
  /// Whether all numbers in it are positive.
  bool is_positive() const { return arb_is_positive(value_) != 0; }
  bool holds_zero() const { return arb_contains_zero(value_) != 0; }
  /// Whether all numbers in it are less than all in the other.
  bool is_below(const RealBall& other) const { return arb_lt(value_, other.value_) != 0; }

 private:
  arb_t value_;
};

inline RealBall operator+(const RealBall& a, const RealBall& b) {
  RealBall sum = a;
  sum += b;
  return sum;
}
inline RealBall operator-(const RealBall& a, const RealBall& b) {
  RealBall difference = a;
  difference -= b;
  return difference;
}
inline RealBall operator*(const RealBall& a, const RealBall& b) {
  RealBall product;
  arb_mul(raw(product), raw(a), raw(b), BallScope::bits());
  return product;
}
inline RealBall operator/(const RealBall& a, const RealBall& b) {
  RealBall quotient;
  arb_div(raw(quotient), raw(a), raw(b), BallScope::bits());
  return quotient;
}
inline RealBall operator-(RealBall a) {
  arb_neg(raw(a), raw(a));
  return a;
}
/// The number itself, without a radius.
inline RealBall exact_ball(mpfr_srcptr x) {
  RealBall ball;
  arf_set_mpfr(arb_midref(raw(ball)), x);
  return ball;
}
inline RealBall exact_ball(double x) {
  RealBall ball;
  arb_set_d(raw(ball), x);
  return ball;
}
/// The double next to its centre.
inline double centre_of(arb_srcptr x) { return arf_get_d(arb_midref(x), ARF_RND_NEAR); }

inline RealBall square_root(RealBall a) {
  arb_sqrt(raw(a), raw(a), BallScope::bits());
  return a;
}
inline RealBall exponential(RealBall a) {
  arb_exp(raw(a), raw(a), BallScope::bits());
  return a;
}
inline RealBall power(RealBall a, unsigned long n) {
  arb_pow_ui(raw(a), raw(a), n, BallScope::bits());
  return a;
}
/// 2^x.
inline RealBall power_of_two_of(double x) {
  const RealBall two = 2;
  RealBall a = exact_ball(x);
  arb_pow(raw(a), raw(two), raw(a), BallScope::bits());
  return a;
}

/// The least number that |x| does not exceed, for any x in the ball, or little more.
inline RealBall greatest_magnitude(const RealBall& x) {
  RealBall bound;
  arb_get_abs_ubound_arf(arb_midref(raw(bound)), raw(x), BallScope::bits());
  return bound;
}
inline RealBall least_magnitude(const RealBall& x) {
  RealBall bound;
  arb_get_abs_lbound_arf(arb_midref(raw(bound)), raw(x), BallScope::bits());
  return bound;
}
inline const RealBall& greater(const RealBall& a, const RealBall& b) {
  return arf_cmp(arb_midref(raw(a)), arb_midref(raw(b))) < 0 ? b : a;
}
/// The ball with a radius greater by a bound, which is positive.
inline RealBall widened(RealBall x, const RealBall& bound) {
  arb_add_error(raw(x), raw(bound));
  return x;
}

}  // namespace hbvm::core
