#include "scene/traced_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hbvm::core {
namespace {

LevelFunction traced_function(const std::function<double(const Vector<double>&)>& g) {
  return [g](const Matrix<double>& points) -> Vector<double> {
    Vector<double> result(points.rows());
    for (Index i = 0; i < points.rows(); ++i) result[i] = g(points.row(i).transpose());
    return result;
  };
}

double length_of(const PointLine& line) {
  double sum = 0;
  for (std::size_t n = 1; n < line.size(); ++n)
    sum += std::hypot(line[n][0] - line[n - 1][0], line[n][1] - line[n - 1][1], line[n][2] - line[n - 1][2]);
  return sum;
}

TEST(TracedCurve, ComesBack) {
  const auto ellipse = traced_function([](const auto& x) { return x[0] * x[0] / 9 + x[1] * x[1] - 1; });
  const PointLine line = traced_curve({ellipse}, {3, 0, 0}, {{-4, -4, 0}, {4, 4, 0}}, 2);
  ASSERT_GT(line.size(), 100u);
  EXPECT_EQ(line.front(), line.back());
  for (const auto& x : line) {
    EXPECT_NEAR(x[0] * x[0] / 9 + x[1] * x[1], 1, 1e-10);
    EXPECT_EQ(x[2], 0);
  }
  EXPECT_NEAR(length_of(line), 13.3649, 1e-3) << "4 a E(e)";
}

/// x = cos z, y = sin z, from z = 0 as far as the box both ways.
TEST(TracedCurve, OfTwoFunctionsLeavesTheBoxAtBothEnds) {
  const std::vector<LevelFunction> helix{traced_function([](const auto& x) { return x[0] - std::cos(x[2]); }),
                                         traced_function([](const auto& x) { return x[1] - std::sin(x[2]); })};
  const PointLine line = traced_curve(helix, {1, 0, 0}, {{-2, -2, -1}, {2, 2, 5}}, 3);
  for (const auto& x : line) {
    EXPECT_NEAR(x[0], std::cos(x[2]), 1e-9);
    EXPECT_NEAR(x[1], std::sin(x[2]), 1e-9);
  }
  const auto [low, high] = std::minmax(line.front()[2], line.back()[2]);
  EXPECT_NEAR(low, -1, 0.03);
  EXPECT_NEAR(high, 5, 0.03);
  EXPECT_NEAR(length_of(line), std::sqrt(2) * (high - low), 1e-3);
}

/// A circle that is small in its box has no corners that are seen; at a corner it goes on.
TEST(TracedCurve, FollowsBends) {
  const auto circle = traced_function([](const auto& x) { return x[0] * x[0] + x[1] * x[1] - 1; });
  const PointLine line = traced_curve({circle}, {1, 0, 0}, {{-50, -50, 0}, {50, 50, 0}}, 2);
  EXPECT_EQ(line.front(), line.back());
  EXPECT_NEAR(length_of(line), 2 * M_PI, 0.02);
  const auto corner = traced_function([](const auto& x) { return x[1] - std::abs(x[0] - 0.1234); });
  const PointLine both = traced_curve({corner}, {1.1234, 1, 0}, {{-2, -2, 0}, {2, 2, 0}}, 2);
  const auto [low, high] = std::minmax(both.front()[0], both.back()[0]);
  EXPECT_LT(low, -1.8);
  EXPECT_GT(high, 1.9);
}

/// From beside the curve it goes there first; without a curve there is none.
TEST(TracedCurve, BeginsOnTheCurve) {
  const auto line = traced_function([](const auto& x) { return x[1] - 1; });
  EXPECT_NEAR(traced_curve({line}, {0, 1.25, 0}, {{-2, -2, 0}, {2, 2, 0}}, 2).front()[1], 1, 1e-12);
  const auto nowhere = traced_function([](const auto& x) { return x[0] * x[0] + x[1] * x[1] + 1; });
  EXPECT_TRUE(traced_curve({nowhere}, {0.3, 0.4, 0}, {{-2, -2, 0}, {2, 2, 0}}, 2).empty());
  // Where the curve has no tangent it ends.
  const auto half = traced_function([](const auto& x) { return x[1] - std::sqrt(x[0]); });
  const PointLine root = traced_curve({half}, {1, 1, 0}, {{-2, -2, 0}, {2, 2, 0}}, 2);
  ASSERT_FALSE(root.empty());
  for (const auto& x : root) EXPECT_NEAR(x[1] * x[1], x[0], 1e-8);
}

}  // namespace
}  // namespace hbvm::core
