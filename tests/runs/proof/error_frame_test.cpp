#include "run/proof/error_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hbvm::core {
namespace {

BallMatrix turn(double angle) {
  BallMatrix M(2, 2);
  RealBall cosine, sine;
  arb_sin_cos(raw(sine), raw(cosine), raw(exact_ball(angle)), 128);
  M.set(0, 0, cosine);
  M.set(0, 1, -sine);
  M.set(1, 0, sine);
  M.set(1, 1, cosine);
  return M;
}

BallMatrix column(const RealBall& x, const RealBall& y) {
  BallMatrix result(2, 1);
  result.set(0, 0, x);
  result.set(1, 0, y);
  return result;
}

BallMatrix small_box() {
  const RealBall error = exact_ball(std::ldexp(double{1}, -100));
  return column(widened(0, error), widened(0, error));
}

/// A box that is turned again and again would grow by |cos 1| + |sin 1| each time, to 10^14.
TEST(ErrorFrame, DoesNotGrowWithTurns) {
  const BallScope bits(128);
  const BallMatrix box = small_box();
  ErrorFrame frame(box, {1, 1});
  BallMatrix wrapped = box;
  for (int n = 0; n < 100; ++n) {
    frame.map(turn(1), column(0, 0));
    wrapped = turn(1) * wrapped;
  }
  const double unit = std::ldexp(double{1}, -100);
  EXPECT_LT(centre_of(raw(greatest_magnitude(frame.hull().at(0, 0)))), 2 * unit);
  EXPECT_GT(centre_of(raw(greatest_magnitude(wrapped.at(0, 0)))), 1e13 * unit);
}

/// It holds each error that was in the box, wherever the maps take it, and what is added on the way.
TEST(ErrorFrame, HoldsAllErrors) {
  const BallScope bits(128);
  const RealBall unit = exact_ball(std::ldexp(double{1}, -100));
  for (const int corner : {0, 1, 2, 3}) {
    // A shear that stretches one direction, and one component in units of its own.
    BallMatrix shear(2, 2);
    shear.set(0, 0, 2);
    shear.set(0, 1, 1 << 20);
    shear.set(1, 1, 1);
    ErrorFrame frame(small_box(), {1 << 20, 1});
    BallMatrix error = column(corner % 2 == 0 ? unit : -unit, corner / 2 == 0 ? unit : -unit);
    for (int n = 1; n < 40; ++n) {
      const BallMatrix M = n % 2 == 0 ? shear : turn(n), added = column(unit * RealBall(n), -unit);
      frame.map(M, added);
      error = M * error + added;
      for (const Index i : {0, 1})
        EXPECT_TRUE(arb_overlaps(frame.hull()(i, 0), error(i, 0)) != 0) << corner << " " << n << " " << i;
    }
  }
}

/// Errors that stay where they are keep their bounds, and those that shrink shrink.
TEST(ErrorFrame, IsTight) {
  const BallScope bits(128);
  BallMatrix half(2, 2);
  half.set(0, 0, RealBall(1) / RealBall(2));
  half.set(1, 1, 1);
  ErrorFrame frame(small_box(), {1, 1});
  for (int n = 0; n < 50; ++n) frame.map(half, column(0, 0));
  const BallMatrix hull = frame.hull();
  EXPECT_LT(centre_of(raw(greatest_magnitude(hull.at(0, 0)))), std::ldexp(double{1}, -148));
  EXPECT_LT(centre_of(raw(greatest_magnitude(hull.at(1, 0)))), std::ldexp(1.01, -100));
}

}  // namespace
}  // namespace hbvm::core
