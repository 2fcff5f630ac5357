#pragma once

#include "scalar/arb.hpp"
#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// A set of complex numbers: a rectangle about a centre, by Arb's ball arithmetic, whose exponents have no bounds.
class Ball {
 public:
  /// The bits that operations keep of a centre: bounds need no more.
  static constexpr slong bits = 64;

  Ball() { acb_init(value_); }
  explicit Ball(const Mpfr& x) : Ball() {
    arf_set_mpfr(arb_midref(acb_realref(value_)), raw(x));
    arb_set_round(acb_realref(value_), acb_realref(value_), bits);
  }
  Ball(const Ball& other) : Ball() { acb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { acb_swap(value_, other.value_); }
  Ball& operator=(Ball other) noexcept {
    acb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { acb_clear(value_); }

  acb_ptr raw_ball() { return value_; }
  acb_srcptr raw_ball() const { return value_; }
  arb_srcptr real() const { return acb_realref(value_); }
  arb_srcptr imaginary() const { return acb_imagref(value_); }
  bool is_finite() const { return acb_is_finite(value_) != 0; }
  /// log2 of an upper bound of what is in it, roughly; -infinity of 0 alone.
  double log2_size() const {
    mag_t size;
    mag_init(size);
    acb_get_mag(size, value_);
    const double result = mag_get_d_log2_approx(size);
    mag_clear(size);
    return result;
  }

 private:
  acb_t value_;
};

inline acb_ptr raw(Ball& x) { return x.raw_ball(); }
inline acb_srcptr raw(const Ball& x) { return x.raw_ball(); }

}  // namespace hbvm::core
