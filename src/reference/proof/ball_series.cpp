#include "ball_series.hpp"

namespace hbvm::core {

BallSeries BallSeries::exactly(const Mpfr* coefficients, Index count) {
  BallSeries result;
  arb_poly_fit_length(result.value_, count);
  for (Index n = 0; n < count; ++n) result.set(n, exact_ball(raw(coefficients[n])));
  return result;
}

RealBall BallSeries::operator[](Index n) const {
  RealBall a;
  arb_poly_get_coeff_arb(raw(a), value_, n);
  return a;
}

BallSeries BallSeries::shortened(Index length) const {
  BallSeries result = *this;
  arb_poly_truncate(result.value_, length);
  return result;
}

BallSeries BallSeries::operator*(const RealBall& a) const {
  BallSeries result;
  arb_poly_scalar_mul(result.value_, value_, raw(a), BallScope::bits());
  return result;
}

BallSeries BallSeries::times(const BallSeries& b, Index length) const {
  BallSeries result;
  arb_poly_mullow(result.value_, value_, b.value_, length, BallScope::bits());
  return result;
}

BallSeries BallSeries::derivative() const {
  BallSeries result;
  arb_poly_derivative(result.value_, value_, BallScope::bits());
  return result;
}

RealBall BallSeries::at(const RealBall& time) const {
  RealBall result;
  if (arb_is_exact(raw(time)) != 0) {
    arb_poly_evaluate(raw(result), value_, raw(time), BallScope::bits());
    return result;
  }
  // By the mean value theorem about the centre.
  RealBall centre, slope;
  arb_get_mid_arb(raw(centre), raw(time));
  arb_poly_evaluate(raw(result), value_, raw(centre), BallScope::bits());
  arb_poly_evaluate_horner(raw(slope), raw(derivative()), raw(time), BallScope::bits());
  result.add_product(slope, time - centre);
  return result;
}

BallSeries BallSeries::rounded_within(const RealBall& r) const {
  RealBall little = size_within(r), tail,
           power_of_r = power(greatest_magnitude(r), static_cast<unsigned long>(length()));
  arb_mul_2exp_si(raw(little), raw(little), -BallScope::bits());
  Index kept = length();
  for (; kept > 1; --kept) {
    power_of_r = power_of_r / greatest_magnitude(r);
    const RealBall more = greatest_magnitude(tail + greatest_magnitude((*this)[kept - 1]) * power_of_r);
    if (!more.is_below(little)) break;
    tail = more;
  }
  BallSeries result = shortened(kept);
  arb_poly_set_round(result.value_, result.value_, BallScope::bits());
  if (kept > 0) result.set(0, widened(result[0], tail));
  return result;
}

RealBall BallSeries::size_within(const RealBall& r) const {
  RealBall sum, radius = greatest_magnitude(r);
  for (Index n = length(); n-- > 0;) {
    sum = sum * radius;
    sum += greatest_magnitude((*this)[n]);
  }
  return greatest_magnitude(sum);
}

}  // namespace hbvm::core
