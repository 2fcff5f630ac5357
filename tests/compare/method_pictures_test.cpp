#include "compare/method_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runs/request_of.hpp"

namespace hbvm::core {
namespace {

struct Compared {
  RunRequest request;
  std::vector<RecordedMethod> runs;

  Compared(const char* scene, const std::vector<const char*>& names, const char* step, const char* until)
      : request(request_of(load_scene(scene), "rattle", step, until)) {
    runs = run_methods(request, named_methods({names.begin(), names.end()}), {});
  }
  Figure figure() const { return methods_figure(request, runs, "hbvm compare"); }
  nlohmann::json page() const {
    const std::string page = methods_page(request, runs, "hbvm compare");
    const std::size_t at = page.find('>', page.find("<script type=\"application/json\"")) + 1;
    return nlohmann::json::parse(page.substr(at, page.find("</", at) - at));
  }
};

TEST(MethodPictures, HaveACurveAMethodInEachPanel) {
  const Figure figure = Compared("double_pendulum", {"hbvm:4,2", "rattle"}, "1/16", "2").figure();
  ASSERT_EQ(figure.panels.size(), 5u);
  for (const Panel& panel : figure.panels) {
    ASSERT_EQ(panel.curves.size(), 2u) << panel.title;
    EXPECT_EQ(panel.curves[0].label, plain("hbvm:4,2"));
    EXPECT_EQ(panel.curves[1].label, "rattle");
  }
  EXPECT_TRUE(figure.panels[0].equal_axes);
  EXPECT_EQ(figure.panels[1].y.scale, AxisScale::decimal);
  EXPECT_EQ(figure.panels[2].y.scale, AxisScale::linear);
  EXPECT_EQ(Compared("kepler", {"rk4"}, "1/16", "2").figure().panels.size(), 3u);
  EXPECT_EQ(Compared("heavy_top", {"rattle"}, "1/16", "1").figure().panels.size(), 6u);
}

/// Both pendulums of a method are one curve, with a gap between them.
TEST(MethodPictures, JoinThePathsOfAMotion) {
  const Compared compared("double_pendulum", {"rattle"}, "1/16", "2");
  const Curve curve = compared.figure().panels[0].curves[0];
  const auto gap =
      std::find_if(curve.points.begin(), curve.points.end(), [](const PlotPoint& x) { return std::isnan(x[0]); });
  ASSERT_GT(curve.points.end() - gap, 33);
  EXPECT_GE(gap - curve.points.begin(), 33);
  EXPECT_EQ((*(gap + 1))[0], compared.runs[0].recording.samples[0].q[2]);
}

std::vector<Polyline> lines_of(const Panel& panel, std::size_t colour) {
  std::vector<Polyline> lines;
  for (const Polyline& line : panel.lines)
    if (line.colour == colour) lines.push_back(line);
  return lines;
}

/// Bodies and rods of each method where it ends, in its colour; what is fixed stands there once, and is black.
TEST(MethodPictures, DrawTheBodiesOfEachMotionAtItsEnd) {
  const Compared compared("double_pendulum", {"hbvm:4,2", "rk4"}, "1/8", "4");
  const Panel panel = compared.figure().panels[0];
  for (std::size_t run = 0; run < 2; ++run) {
    const std::vector<double>& q = compared.runs[run].recording.samples.back().q;
    const std::vector<Polyline> rods = lines_of(panel, run);
    ASSERT_EQ(rods.size(), 2u);
    EXPECT_EQ(rods[1].points, (std::vector<PlotPoint>{{q[0], q[1]}, {q[2], q[3]}}));
    EXPECT_EQ(rods[1].look, Polyline::Look::solid);
    EXPECT_TRUE(rods[1].dashed);
    for (std::size_t body = 0; body < 2; ++body)
      EXPECT_EQ(std::count_if(panel.marks.begin(), panel.marks.end(),
                              [&](const Mark& mark) {
                                return mark.look == Mark::Look::body && mark.colour == run &&
                                       mark.at == PlotPoint{q[2 * body], q[2 * body + 1]};
                              }),
                1);
  }
  EXPECT_EQ(std::count_if(panel.marks.begin(), panel.marks.end(),
                          [](const Mark& mark) { return mark.look == Mark::Look::fixed && !mark.colour; }),
            1);
  EXPECT_EQ(panel.lines.size(), 6u) << "two rods at the start, dashed, and two of each method";
}

TEST(MethodPictures, DrawRigidBodiesAtTheEnd) {
  const Figure figure = Compared("heavy_top", {"rk4", "hbvm:2,2"}, "1/10", "2").figure();
  for (std::size_t panel = 0; panel < 2; ++panel)
    for (std::size_t run = 0; run < 2; ++run) {
      const std::vector<Polyline> lines = lines_of(figure.panels[panel], run);
      EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.points.size() > 20; }));
      EXPECT_TRUE(
          std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.look == Polyline::Look::bar; }));
    }
}

/// Satellites that go round the Earth are far from where they were, and none of that is left out.
TEST(MethodPictures, ShowAllOfAMotionThatStays) {
  const Figure figure = Compared("tethered_satellites", {"hbvm:2,2", "rattle"}, "1/4", "50").figure();
  for (const Curve& curve : figure.panels[0].curves) {
    const auto gaps =
        std::count_if(curve.points.begin(), curve.points.end(), [](const PlotPoint& x) { return std::isnan(x[0]); });
    EXPECT_EQ(gaps, 2) << "between three bodies";
  }
}

/// Explicit Euler spirals away from the sun; it is seen until it has left what the others stay in, its error is all.
TEST(MethodPictures, ShowAMotionUntilItLeaves) {
  const Compared compared("kepler", {"euler", "rattle"}, "1/8", "100");
  const Figure figure = compared.figure();
  const auto seen = [](const Curve& curve) {
    return std::count_if(curve.points.begin(), curve.points.end(),
                         [](const PlotPoint& x) { return std::isfinite(x[0]); });
  };
  const long all = seen(figure.panels[0].curves[1]);
  EXPECT_GE(all, 801);
  EXPECT_LT(seen(figure.panels[0].curves[0]), all);
  EXPECT_GT(seen(figure.panels[0].curves[0]), 10);
  EXPECT_EQ(figure.panels[1].curves[0].points.size(), 801u);
  const std::vector<PlotPoint>& path = figure.panels[0].curves[0].points;
  const auto end = std::find_if(path.rbegin(), path.rend(), [](const PlotPoint& x) { return std::isfinite(x[0]); });
  const std::vector<Mark>& marks = figure.panels[0].marks;
  const auto planet = std::find_if(marks.begin(), marks.end(), [](const Mark& mark) { return mark.colour == 0u; });
  ASSERT_NE(planet, marks.end());
  EXPECT_NEAR(planet->at[0], (*end)[0], 1e-12) << "where it was last seen";
}

/// Every motion has its places, its coordinates and one colour; what is fixed has none and is named once.
TEST(MethodPictures, APageMovesAllOnOneClock) {
  const Compared compared("double_pendulum", {"hbvm:4,2", "rattle"}, "1/16", "2");
  const nlohmann::json data = compared.page(), places = data["sketch"]["places"];
  ASSERT_EQ(places.size(), 6u);
  EXPECT_EQ(data["charts"].size(), 4u);
  EXPECT_EQ(data["samples"].size(), 33u);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool moves = !places[i]["blocks"].empty();
    const long run = i < 3 ? 0 : 1;
    EXPECT_EQ(places[i]["colour"], moves ? run : -1);
    EXPECT_EQ(places[i]["labelled"], moves || run == 0);
    if (!moves) continue;
    const std::size_t column = 1 + places[i]["blocks"][0][0].get<std::size_t>();
    const double x = data["samples"][20][column];
    const Recording::Sample& sample = compared.runs[static_cast<std::size_t>(run)].recording.samples[20];
    EXPECT_EQ(x, sample.q[(column - 1) % 4]);
    const double v = sample.v[(column - 1) % 4];
    EXPECT_NEAR(data["velocities"][20][(column - 1) / 2][0].get<double>(), v, 1e-4 * std::abs(v));
  }
}

TEST(MethodPictures, CallASingleBodyByItsMethod) {
  const nlohmann::json places = Compared("kepler", {"gauss:2", "rk4"}, "1/16", "2").page()["sketch"]["places"];
  std::vector<std::string> names;
  for (const auto& place : places)
    if (place["has_mass"]) names.push_back(place["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"gauss:2", "rk4"}));
}

}  // namespace
}  // namespace hbvm::core
