#include "reference/proof/ball_series.hpp"

#include "printing.hpp"
#include "reference/proof/holds.hpp"

namespace hbvm::core {
namespace {

/// 1 - 2 s + 3 s^2, exactly.
BallSeries polynomial() {
  const Mpfr coefficients[] = {Mpfr(1), Mpfr(-2), Mpfr(3)};
  return BallSeries::exactly(coefficients, 3);
}

TEST(BallSeries, AreAddedMultipliedAndDerived) {
  const PrecisionScope digits(30);
  const BallScope bits(100);
  const BallSeries x = polynomial(), square = x.times(x, 4), slope = x.derivative();
  const int of_square[] = {1, -4, 10, -12};
  ASSERT_EQ(square.length(), 4);
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(holds(square[n], Mpfr(of_square[n]))) << n;
  EXPECT_TRUE(holds(slope[0], Mpfr(-2)));
  EXPECT_TRUE(holds(slope[1], Mpfr(6)));
  BallSeries sum = x * RealBall(3);
  sum += x;
  sum -= BallSeries(RealBall(4));
  EXPECT_TRUE(holds(sum[0], Mpfr(0)));
  EXPECT_TRUE(holds(sum[2], Mpfr(12)));
  EXPECT_EQ(sum.shortened(2).length(), 2);
  EXPECT_TRUE(holds(sum[7], Mpfr(0)));  // beyond its end
}

/// On a ball of times its width is that of the derivative, and a little more.
TEST(BallSeries, HoldAllValuesOnABallOfTimes) {
  const PrecisionScope digits(30);
  const BallScope bits(100);
  RealBall time;
  arb_set_d(raw(time), 0.75);
  mag_set_d(arb_radref(raw(time)), 0.125);
  const RealBall values = polynomial().at(time);
  for (int i = 0; i <= 16; ++i) {
    const Mpfr s = Mpfr(5) / 8 + Mpfr(i) / 64;
    EXPECT_TRUE(holds(values, Mpfr(1 - 2 * s + 3 * s * s))) << i;
  }
  // |6 s - 2| <= 3.25 times 0.125.
  EXPECT_LT(radius_of(values), 0.41);
  EXPECT_GE(radius_of(values), 0.40);
}

TEST(BallSeries, AreBoundedInADisc) {
  const PrecisionScope digits(30);
  const BallScope bits(100);
  const RealBall size = polynomial().size_within(RealBall(2));
  EXPECT_TRUE(holds(size - RealBall(17), Mpfr(0)));
  RealBall wide = 2;
  mag_set_d(arb_radref(raw(wide)), 1);
  EXPECT_TRUE(RealBall(33).is_below(polynomial().size_within(wide)));
}

}  // namespace
}  // namespace hbvm::core
