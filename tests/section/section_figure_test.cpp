#include "section/section_figure.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(SectionFigure, DrawsPointsOfOrbitsInTheirColours) {
  Section section;
  section.plane = "a.x";
  section.direction = "up";
  for (int n = 0; n < 12; ++n) {
    SectionOrbit& orbit = section.orbits.emplace_back();
    orbit.points = {{"1", std::to_string(n), "2"}, {"3", "4", "5"}};
  }
  const Figure figure = section_figure(section);
  ASSERT_EQ(figure.panels.size(), 1u);
  const Panel& panel = figure.panels.front();
  ASSERT_EQ(panel.curves.size(), curve_colours.size());
  EXPECT_TRUE(panel.curves[0].dots);
  // The tenth orbit has the colour of the first.
  EXPECT_EQ(panel.curves[0].points.size(), 4u);
  EXPECT_EQ(panel.curves[8].points.size(), 2u);
  EXPECT_EQ(panel.curves[1].points[0], (PlotPoint{1, 2}));
  EXPECT_EQ(panel.title, "24 points of 12 orbits where a.x = 0, upwards");
}

}  // namespace
}  // namespace hbvm::core
