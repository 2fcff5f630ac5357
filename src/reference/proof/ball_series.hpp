#pragma once

#include <vector>

#include "linear/index.hpp"
#include "scalar/arb.hpp"
#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// The first coefficients of a power series, each a ball, by Arb's polynomials: products are fast for many terms.
class BallSeries {
 public:
  BallSeries() { arb_poly_init(value_); }
  explicit BallSeries(const RealBall& constant) : BallSeries() { arb_poly_set_coeff_arb(value_, 0, raw(constant)); }
  BallSeries(const BallSeries& other) : BallSeries() { arb_poly_set(value_, other.value_); }
  BallSeries(BallSeries&& other) noexcept : BallSeries() { arb_poly_swap(value_, other.value_); }
  BallSeries& operator=(BallSeries other) noexcept {
    arb_poly_swap(value_, other.value_);
    return *this;
  }
  ~BallSeries() { arb_poly_clear(value_); }

  /// The series with these exact coefficients.
  static BallSeries exactly(const Mpfr* coefficients, Index count);

  Index length() const { return arb_poly_length(value_); }
  RealBall operator[](Index n) const;
  void set(Index n, const RealBall& a) { arb_poly_set_coeff_arb(value_, n, raw(a)); }
  /// The terms below degree `length` alone.
  BallSeries shortened(Index length) const;

  friend arb_poly_struct* raw(BallSeries& x) { return x.value_; }
  friend const arb_poly_struct* raw(const BallSeries& x) { return x.value_; }

  BallSeries& operator+=(const BallSeries& b) {
    arb_poly_add(value_, value_, b.value_, BallScope::bits());
    return *this;
  }
  BallSeries& operator-=(const BallSeries& b) {
    arb_poly_sub(value_, value_, b.value_, BallScope::bits());
    return *this;
  }
  BallSeries operator*(const RealBall& a) const;
  /// The product's terms below degree `length`.
  BallSeries times(const BallSeries& b, Index length) const;
  BallSeries derivative() const;

  /// The values on a ball of times.
  RealBall at(const RealBall& time) const;
  /// A series with as many bits as the scope has, that holds this one's values for 0 <= s <= r. What its last terms add
  /// up to is in the radius of its first, where that is round-off.
  BallSeries rounded_within(const RealBall& r) const;
  /// A bound of sum |x_n| r^n, and so of what the series is in the complex disc |s| <= r.
  RealBall size_within(const RealBall& r) const;

 private:
  arb_poly_t value_;
};

}  // namespace hbvm::core
