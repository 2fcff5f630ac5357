#include "audit/slope_triangle.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

/// Errors of order 2: the long side is parallel to the curve, and below it.
TEST(SlopeTriangle, HasTheSlopeOfItsCurve) {
  std::vector<Rung> rungs;
  for (int i = 0; i < 6; ++i) rungs.push_back({-3.0 - i, -10.0 - 2 * i, -100});
  Panel panel;
  add_slope_triangle(panel, rungs, 4, 2);
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

}  // namespace
}  // namespace hbvm::core
