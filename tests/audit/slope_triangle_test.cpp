#include "audit/slope_triangle.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

/// Errors of order 2: the long side is parallel to the curve, and below it.
TEST(SlopeTriangle, HasTheSlopeOfItsCurve) {
  std::vector<Rung> rungs;
  for (int i = 0; i < 6; ++i) rungs.push_back({-3.0 - i, -10.0 - 2 * i, -100});
  Panel panel;
  add_slope_triangle(panel, slope_triangle(rungs, 4, 2));
  const std::vector<PlotPoint>& corners = panel.lines.at(0).points;
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_EQ(corners[0][0], -7);
  EXPECT_EQ(corners[2][0], -5);
  EXPECT_NEAR((corners[2][1] - corners[0][1]) / log10_of_2, 4, 1e-12);
  for (std::size_t i = 0; i < 2; ++i) {
    const PlotPoint& corner = corners[2 * i];
    EXPECT_LT(corner[1], (-10 + 2 * (corner[0] + 3)) * log10_of_2);
  }
  EXPECT_EQ(panel.labels.at(0).text, "2");
}

/// Errors of 2^-n of an order, from 2^first on.
std::vector<Rung> line_of(int order, double first) {
  std::vector<Rung> rungs;
  for (int i = 0; i < 6; ++i) rungs.push_back({-3.0 - i, first - order * i, -1000});
  return rungs;
}

Panel with_triangles(const std::map<int, std::vector<std::vector<Rung>>>& slopes) {
  Panel panel;
  for (const auto& [slope, curves] : slopes)
    for (const std::vector<Rung>& rungs : curves) {
      Curve& curve = panel.curves.emplace_back();
      for (const Rung& rung : rungs) curve.points.push_back({rung.step, rung.error * log10_of_2});
    }
  add_slope_triangles(panel, slopes);
  return panel;
}

TEST(SlopeTriangle, IsOneForAllCurvesOfASlope) {
  const Panel panel = with_triangles({{4, {line_of(4, -10), line_of(4, -13)}}, {6, {line_of(6, -30)}}});
  ASSERT_EQ(panel.lines.size(), 2u);
  EXPECT_EQ(panel.labels.at(0).text, "4");
  EXPECT_EQ(panel.labels.at(1).text, "6");
  // Below the lower of the two, which it would cross below the other.
  const PlotPoint& corner = panel.lines[0].points[0];
  EXPECT_LT(corner[1], (-13 + 4 * (corner[0] + 3)) * log10_of_2);
}

/// Two slopes that are nearly on each other.
TEST(SlopeTriangle, StandsOnNoOther) {
  const Panel panel = with_triangles({{3, {line_of(3, -15)}}, {4, {line_of(4, -11)}}});
  ASSERT_EQ(panel.lines.size(), 2u);
  const std::vector<PlotPoint>&a = panel.lines[0].points, &b = panel.lines[1].points;
  const bool apart = a[1][0] < b[0][0] || b[1][0] < a[0][0] || a[2][1] < b[0][1] || b[2][1] < a[0][1];
  EXPECT_TRUE(apart);
}

TEST(SlopeTriangle, ShowsNoRoundOff) {
  std::vector<Rung> rungs = line_of(4, -10);
  rungs.back().floor = 0;
  EXPECT_EQ(with_triangles({{4, {rungs}}}).lines.at(0).points[0][0], -7);
}

}  // namespace
}  // namespace hbvm::core
