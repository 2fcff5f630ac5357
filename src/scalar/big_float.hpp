#pragma once

#include <mpfr.h>

namespace hbvm::core {

/// An mpfr_t with a number of bits of its own, whatever the precision of the scope. It is for code that works with
/// guard bits and rounds once at the end. (A Boost number takes the digits of the scope whenever it is copied or
/// moved.)
class BigFloat {
 public:
  explicit BigFloat(long bits) { mpfr_init2(value_, bits); }
  BigFloat(const BigFloat& other) : BigFloat(mpfr_get_prec(other.value_)) { mpfr_set(value_, other.value_, MPFR_RNDN); }
  BigFloat& operator=(const BigFloat& other) {
    if (this == &other) return *this;
    mpfr_set_prec(value_, mpfr_get_prec(other.value_));
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  BigFloat(BigFloat&& other) noexcept : BigFloat(MPFR_PREC_MIN) { mpfr_swap(value_, other.value_); }
  BigFloat& operator=(BigFloat&& other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  ~BigFloat() { mpfr_clear(value_); }

  friend mpfr_ptr raw(BigFloat& x) { return x.value_; }
  friend mpfr_srcptr raw(const BigFloat& x) { return x.value_; }

 private:
  mpfr_t value_;
};

}  // namespace hbvm::core
