#include "run/run_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runs/request_of.hpp"

namespace hbvm::core {
namespace {

/// A short run of a scene and its figure.
std::pair<Recording, Figure> shown(const char* name) {
  const Scene scene = load_scene(name);
  const Recording recording = recorded<double>(scene, "1/16", "1").first;
  return {recording, run_figure(sketch(scene), recording)};
}

TEST(RunFigure, ShowsAPlanarMotionInItsPlane) {
  const auto [recording, figure] = shown("double_pendulum");
  ASSERT_EQ(figure.panels.size(), 3u);
  const Panel& motion = figure.panels.front();
  EXPECT_TRUE(motion.equal_axes);
  ASSERT_EQ(motion.curves.size(), 2u);
  const Recording::Sample& last = recording.samples.back();
  EXPECT_EQ(motion.curves[1].points.back(), (PlotPoint{last.q[2], last.q[3]}));
  // Two rods at the start, two at the end, the last of them between the bodies as they are then.
  ASSERT_EQ(motion.lines.size(), 4u);
  EXPECT_EQ(motion.lines[3].points, (std::vector<PlotPoint>{{last.q[0], last.q[1]}, {last.q[2], last.q[3]}}));
  EXPECT_EQ(motion.lines[0].look, Polyline::Look::dashed);
  EXPECT_EQ(motion.lines[3].look, Polyline::Look::solid);
  const Panel& multipliers = figure.panels[1];
  ASSERT_EQ(multipliers.curves.size(), 2u);
  EXPECT_EQ(multipliers.curves[1].points[3], (PlotPoint{recording.samples[3].t, recording.samples[3].lambda[1]}));
}

TEST(RunFigure, ShowsAMotionInSpaceFromTwoSides) {
  const auto [recording, figure] = shown("tethered_satellites");
  ASSERT_EQ(figure.panels.size(), 4u);
  const Recording::Sample& last = recording.samples.back();
  EXPECT_EQ(figure.panels[0].curves[2].points.back(), (PlotPoint{last.q[6], last.q[7]}));
  EXPECT_EQ(figure.panels[1].curves[2].points.back(), (PlotPoint{last.q[6], last.q[8]}));
  EXPECT_EQ(figure.panels[1].title, "Motion, seen along y");
}

/// A planar pin of two rigid bodies is two constraints, beside six that keep them rigid; a top has no others.
TEST(RunFigure, ShowsMultipliersOfJointsBeforeThoseOfRigidity) {
  for (const auto& [name, curves] : {std::pair("double_physical_pendulum", 2u), std::pair("heavy_top", 6u)}) {
    const Figure figure = shown(name).second;
    const Panel& multipliers = figure.panels[figure.panels.size() - 2];
    EXPECT_EQ(multipliers.title, "Lagrange multipliers");
    EXPECT_EQ(multipliers.curves.size(), curves) << name;
    for (const Panel& panel : figure.panels)
      for (const Mark& mark : panel.marks) EXPECT_EQ(mark.label.find('.'), std::string::npos) << mark.label;
  }
}

TEST(RunFigure, ShowsErrorsByTheirLogarithms) {
  const auto [recording, figure] = shown("double_pendulum");
  const Panel& errors = figure.panels.back();
  EXPECT_EQ(errors.y.scale, AxisScale::decimal);
  ASSERT_EQ(errors.curves.size(), 3u);
  EXPECT_EQ(errors.curves[0].points[5][1], recording.samples[5].energy);
  EXPECT_EQ(errors.curves[1].points[5][1], recording.samples[5].constraints);
  EXPECT_EQ(errors.curves[2].points[5][1], recording.samples[5].hidden);
}

TEST(SceneFigure, ShowsAScene) {
  const Scene scene = load_scene("tethered_satellites");
  const Vector<double> q = assemble<double>(scene).q0;
  const Figure figure = scene_figure(sketch(scene), {q.begin(), q.end()});
  ASSERT_EQ(figure.panels.size(), 2u);
  const Polyline& rod = figure.panels[1].lines.back();
  EXPECT_EQ(rod.points, (std::vector<PlotPoint>{{q[0], q[2]}, {q[6], q[8]}}));
}

TEST(RunFigure, OfAFreeMotionHasNoConstraints) {
  const Figure figure = shown("kepler").second;
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[1].curves.size(), 1u);
}

}  // namespace
}  // namespace hbvm::core
