#include "run/run_figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/figure_layout.hpp"
#include "run/scene_run.hpp"
#include "runs/request_of.hpp"
#include "scene/observe.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

/// A short run of a scene and its figure.
std::pair<Recording, Figure> shown(const char* name) {
  const Scene scene = load_scene(name);
  const Recording recording = recorded<double>(scene, "1/16", "1").first;
  return {recording, run_figure(sketch(scene), recording)};
}

/// What a run leaves for a picture, also if it fails on the way.
Recording recording_of(const RunRequest& request) {
  Recording recording;
  RunHooks hooks;
  hooks.recording = &recording;
  try {
    run(request, hooks);
  } catch (const IntegrationError&) {
  }
  return recording;
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

TEST(RunFigure, CallsMultipliersByName) {
  for (const auto& [name, first] : {std::pair("four_bar_linkage_of_bars", "ball joint crank-coupler, x"),
                                    std::pair("gyroscope_on_gimbal", "hinge post-outer, across e")}) {
    const Figure figure = shown(name).second;
    EXPECT_EQ(figure.panels[figure.panels.size() - 2].curves.front().label, first);
  }
}

std::vector<Polyline> lines_of(const Panel& panel, Polyline::Look look) {
  std::vector<Polyline> lines;
  for (const Polyline& line : panel.lines)
    if (line.look == look) lines.push_back(line);
  return lines;
}

/// Each in the colour of its path: a box has nine edges in front, of two points and a gap each.
TEST(RunFigure, DrawsRigidBodiesAsTheyAreAtTheEnd) {
  const auto [recording, figure] = shown("free_rigid_body");
  const Sketch drawn = sketch(load_scene("free_rigid_body"));
  const std::vector<std::array<double, 3>> corners = drawn.corners(drawn.bodies[0], recording.samples.back().q);
  for (const std::size_t panel : {0, 1}) {
    const std::vector<Polyline> solid = lines_of(figure.panels[panel], Polyline::Look::solid);
    ASSERT_EQ(solid.size(), 1u);
    EXPECT_EQ(solid[0].points.size(), 27u);
    EXPECT_EQ(solid[0].colour, 0u);
    for (const PlotPoint& point : solid[0].points)
      EXPECT_TRUE(!std::isfinite(point[0]) || std::any_of(corners.begin(), corners.end(), [&](const auto& corner) {
        return corner[0] == point[0] && corner[1 + panel] == point[1];
      }));
    EXPECT_EQ(lines_of(figure.panels[panel], Polyline::Look::faint).size(), 1u) << "as it was at the start";
  }
}

/// What is nearest to who looks is among what is seen: along z from above, along y from below.
TEST(RunFigure, HidesTheFarSideOfABody) {
  const std::pair<Recording, Figure> run = shown("free_rigid_body");
  const Sketch drawn = sketch(load_scene("free_rigid_body"));
  const std::vector<std::array<double, 3>> corners = drawn.corners(drawn.bodies[0], run.first.samples.back().q);
  for (const std::size_t panel : {0, 1}) {
    const std::size_t across = panel == 0 ? 2 : 1;
    const double side = panel == 0 ? 1 : -1;
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
      return side * a[across] < side * b[across];
    });
    const std::vector<PlotPoint> points = lines_of(run.second.panels[panel], Polyline::Look::solid)[0].points;
    EXPECT_GT(std::count(points.begin(), points.end(), PlotPoint{(*high)[0], (*high)[1 + panel]}), 0);
    EXPECT_EQ(std::count(points.begin(), points.end(), PlotPoint{(*low)[0], (*low)[1 + panel]}), 0);
  }
}

TEST(RunFigure, MarksJointsAndTheirAxes) {
  const auto [recording, figure] = shown("gyroscope_on_gimbal");
  const Panel& panel = figure.panels.front();
  EXPECT_EQ(lines_of(panel, Polyline::Look::axis).size(), 3u);
  const auto marked = [&](Mark::Look look) {
    return std::count_if(panel.marks.begin(), panel.marks.end(), [&](const Mark& mark) { return mark.look == look; });
  };
  EXPECT_EQ(marked(Mark::Look::joint), 4) << "of three hinges, two at one point of the outer ring";
  EXPECT_EQ(marked(Mark::Look::centre), 3);
  EXPECT_EQ(marked(Mark::Look::body), 0);
}

/// Behind all else, and once; other scenes have none.
TEST(RunFigure, ShowsWhatABodyIsHeldOn) {
  const Scene scene = load_scene("bead_on_torus");
  const Recording recording = recorded<double>(scene, "1/16", "1").first;
  const Figure figure = run_figure(sketch(scene, recording.states()), recording);
  EXPECT_EQ(lines_of(figure.panels[0], Polyline::Look::mesh).size(), 1u);
  EXPECT_EQ(figure.panels[0].lines.front().look, Polyline::Look::mesh);
  EXPECT_TRUE(lines_of(shown("tethered_satellites").second.panels[0], Polyline::Look::mesh).empty());
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

/// What is below round-off is shaded, and the axis ends there.
TEST(RunFigure, EndsErrorsAtRoundOff) {
  const auto [recording, figure] = shown("double_pendulum");
  EXPECT_EQ(figure.panels.back().round_off, recording.round_off);
  EXPECT_EQ(layout_of(figure).panels.back().y.from, recording.round_off - 1);
}

TEST(RunFigure, DrawsObservationsAgainstEachOther) {
  Scene scene = with_observation(load_scene("kepler"), "planet.x", "planet.x");
  scene = with_observation(with_observation(scene, "planet.px", "planet.px"), "L", "planet.x*planet.py");
  const Recording recording = recording_of(request_of(scene, "hbvm:2,2", "1/16", "1"));
  const Figure figure = run_figure(sketch(scene), recording, {{"planet.px", "planet.x"}}, true);
  ASSERT_EQ(figure.panels.size(), 5u);
  const Panel& portrait = figure.panels[1];
  EXPECT_EQ(portrait.title, "planet.x against planet.px");
  const Recording::Sample& sample = recording.samples[7];
  EXPECT_EQ(portrait.curves.at(0).points.at(7), (PlotPoint{sample.observed[1], sample.observed[0]}));
  EXPECT_EQ(figure.panels[2].title, "L");
  EXPECT_EQ(figure.panels[3].curves.at(0).points.at(7)[1], sample.H_change);
}

/// Where a sample stands for several mesh points, only what these reach beyond it and the one before is a stroke.
TEST(RunFigure, StrokesAreOnlyOfWhatSamplesDoNotShow) {
  const Scene scene = with_observation(load_scene("kepler"), "x", "planet.x");
  Recording recording;
  recording.observations = {"x"};
  recording.every = 4;
  const auto add = [&](double t, double now, double least, double greatest) {
    Recording::Sample sample = recorded<double>(scene, "1/16", "1").first.samples.front();
    sample.t = t;
    sample.observed = {now};
    sample.least_observed = {least};
    sample.greatest_observed = {greatest};
    recording.samples.push_back(sample);
  };
  add(0, 1, 1, 1);
  add(1, 2, 1.5, 2);  // monotone
  add(2, 1, 1, 2.5);  // turns above both
  add(3, 1.5, 0.5, 1.5);
  const Curve curve = run_figure(sketch(scene), recording).panels.at(1).curves.at(0);
  EXPECT_EQ(curve.points, (std::vector<PlotPoint>{{0, 1}, {1, 2}, {1.5, 2.5}, {2, 1}, {2.5, 0.5}, {3, 1.5}}));
}

/// A path of few steps is a smooth line through them: a circle stays one.
TEST(RunFigure, DrawsSmoothPathsOfFewSteps) {
  const Scene scene = read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, 1] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"o\", \"a\"], length = 1 }]\n",
      "circle");
  const Recording recording = recorded<double>(scene, "1/2", "6").first;
  const Curve path = run_figure(sketch(scene), recording).panels.front().curves.at(0);
  EXPECT_GT(path.points.size(), 1'000u);
  for (const PlotPoint& x : path.points) EXPECT_NEAR(std::hypot(x[0], x[1]), 1, 3e-3);
}

/// A run of forward Euler flies away: its motion is seen until its energy is lost, its errors to the end.
TEST(RunFigure, ShowsALostMotionUntilItIsLost) {
  const Scene scene = load_scene("henon_heiles");
  const Recording recording = recording_of(request_of(scene, "euler", "1/8", "100"));
  const Figure figure = run_figure(sketch(scene), recording);
  EXPECT_TRUE(figure.panels.front().title.starts_with("Motion until ")) << figure.panels.front().title;
  EXPECT_EQ(figure.panels.back().curves.at(0).points.size(), recording.samples.size());
}

/// All of one size, each a little later, the last the whole motion.
TEST(MotionFrames, HaveTheSameAxes) {
  const Scene scene = load_scene("tethered_satellites");
  const Recording recording = recorded<double>(scene, "1/16", "20").first;
  const std::vector<Figure> frames = motion_frames(sketch(scene), recording);
  ASSERT_EQ(frames.size(), 120u);
  const FigureLayout first = layout_of(frames.front()), last = layout_of(frames.back());
  EXPECT_EQ(first.size, last.size);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(first.panels[i].x.from, last.panels[i].x.from);
    EXPECT_EQ(first.panels[i].y.to, last.panels[i].y.to);
  }
  EXPECT_EQ(frames.back().panels[0].title, "t = 20.000, seen along z");
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
