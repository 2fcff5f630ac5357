#include "run/smooth_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hbvm::core {
namespace {

/// n + 1 points of a circle that is gone round `turns` times.
std::vector<PathPoint> circle(int n, double turns = 1) {
  std::vector<PathPoint> points;
  for (int i = 0; i <= n; ++i) {
    const double t = 2 * std::numbers::pi * turns * i / n;
    points.push_back({t, {std::cos(t), std::sin(t)}, {-std::sin(t), std::cos(t)}});
  }
  return points;
}

/// Hermite's cubic is off by (h^4/384) |x''''|.
TEST(SmoothPath, FollowsACircleByFewPoints) {
  const double h = 2 * std::numbers::pi / 12;
  const std::vector<PlotPoint> line = smooth_path(circle(12), 1000);
  EXPECT_GE(line.size(), 900u);
  for (const PlotPoint& x : line) EXPECT_NEAR(std::hypot(x[0], x[1]), 1, h * h * h * h / 384);
  EXPECT_EQ(line.front(), circle(12).front().at);
  EXPECT_EQ(line.back(), circle(12).back().at);
}

/// Back in time it is the same line.
TEST(SmoothPath, GoesBackInTimeToo) {
  std::vector<PathPoint> points = circle(12);
  for (PathPoint& point : points) {
    point.t = -point.t;
    point.velocity = {-point.velocity[0], -point.velocity[1]};
  }
  const std::vector<PlotPoint> line = smooth_path(points, 1000), forward = smooth_path(circle(12), 1000);
  ASSERT_EQ(line.size(), forward.size());
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(line[i][0], forward[i][0], 1e-14);
}

/// Of points that are several turns apart nothing is made up.
TEST(SmoothPath, IsStraightWhereTheMotionTurnsBetweenPoints) {
  EXPECT_EQ(smooth_path(circle(12, 20), 1000).size(), 13u);
}

TEST(SmoothPath, HasWhatIsNoNumberAsItIs) {
  std::vector<PathPoint> points = circle(4);
  points[2].at = {NAN, NAN};
  const std::vector<PlotPoint> line = smooth_path(points, 100);
  EXPECT_TRUE(std::any_of(line.begin(), line.end(), [](const PlotPoint& x) { return std::isnan(x[0]); }));
  EXPECT_TRUE(smooth_path({}, 100).empty());
}

}  // namespace
}  // namespace hbvm::core
