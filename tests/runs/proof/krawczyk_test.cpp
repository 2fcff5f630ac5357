#include "run/proof/krawczyk.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

RealBall ball(double centre, double radius) { return widened(exact_ball(centre), exact_ball(radius)); }

BallMatrix column(const std::vector<RealBall>& entries) {
  BallMatrix x(static_cast<Index>(entries.size()), 1);
  for (std::size_t i = 0; i < entries.size(); ++i) x.set(static_cast<Index>(i), 0, entries[i]);
  return x;
}

/// x^2 + y = c and y = 1, about (x, 1).
Krawczyk test(double x, double c, double radius) {
  BallMatrix J(2, 2);
  J.set(0, 0, RealBall(2) * ball(x, radius));
  J.set(0, 1, 1);
  J.set(1, 1, 1);
  return {
      J, column({exact_ball(x) * exact_ball(x) + RealBall(1) - exact_ball(c), RealBall()}), {1, 1}, exact_ball(radius)};
}

TEST(Krawczyk, FindsOneRoot) {
  const Krawczyk near = test(double{17} / 12, 3, double{1} / 8);
  ASSERT_TRUE(near.proves());
  // The root is sqrt(2), which is 0.0024531 away.
  const double distance = centre_of(raw(near.distance()));
  EXPECT_GE(distance, 0.0024531);
  EXPECT_LT(distance, 0.0028);
}

TEST(Krawczyk, ProvesNothingOfTwoRootsOrNone) {
  EXPECT_TRUE(test(double{17} / 12, 3, double{1} / 2).proves());
  EXPECT_FALSE(test(double{17} / 12, 3, 3).proves()) << "both roots are in the box";
  EXPECT_FALSE(test(double{1} / 8, 0, double{1} / 16).proves()) << "there is no root";
  EXPECT_FALSE(test(double{17} / 12, 3, double{1} / 512).proves()) << "the root is outside";
  EXPECT_FALSE(test(1, 1, double{1} / 4).proves()) << "the root is 0, which is double";
}

/// What is not finite proves nothing.
TEST(Krawczyk, ProvesNothingWithoutBounds) {
  RealBall unknown;
  arb_indeterminate(raw(unknown));
  BallMatrix J(1, 1);
  J.set(0, 0, 1);
  EXPECT_TRUE(Krawczyk(J, column({RealBall()}), {1}, 1).proves());
  EXPECT_FALSE(Krawczyk(J, column({unknown}), {1}, 1).proves());
  J.set(0, 0, unknown);
  EXPECT_FALSE(Krawczyk(J, column({RealBall()}), {1}, 1).proves());
  EXPECT_FALSE(Krawczyk(BallMatrix(1, 1), column({RealBall()}), {1}, 1).proves());
}

/// Each unknown has a unit of its own.
TEST(Krawczyk, MeasuresInUnits) {
  BallMatrix J(1, 1);
  J.set(0, 0, ball(1, double{1} / 4));
  const auto proves = [&](const RealBall& unit) {
    return Krawczyk(J, column({exact_ball(double{1} / 2)}), {unit}, 1).proves();
  };
  EXPECT_TRUE(proves(1));
  EXPECT_FALSE(proves(RealBall(1) / RealBall(2)));
  EXPECT_EQ(centre_of(raw(size_of(column({1, -6}), {1, 2}))), 3);
}

}  // namespace
}  // namespace hbvm::core
