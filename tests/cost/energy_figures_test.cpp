#include <gtest/gtest.h>

#include "cost/energy_cost.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

EnergyCost energy_run_of(const char* method, const char* precision, double seconds, double log10_error) {
  EnergyCost run{CostCell{parse_method(method), Precision::parse(precision), 8}, method};
  run.seconds = seconds;
  run.growth = {{0, log10_error - 1}, {1, log10_error}};
  return run;
}

CostStudy drawn_study() { return {load_scene("kepler"), Expression::parse("10")}; }

TEST(EnergyFigure, DrawsEachMethodAtEqualCostAndAllRuns) {
  std::vector<EnergyCost> runs{energy_run_of("hbvm:2,2", "double", 1, -5), energy_run_of("hbvm:2,2", "double", 2, -6),
                               energy_run_of("rattle", "double", 2, -3),
                               energy_run_of("hbvm:auto,2", "double", 3, -15)};
  runs.back().method = "hbvm:6,2";
  const Figure figure = energy_figure(drawn_study(), Expression::parse("100"), runs);
  ASSERT_EQ(figure.panels.size(), 2u);
  ASSERT_EQ(figure.panels[0].curves.size(), 3u);
  EXPECT_EQ(figure.panels[0].curves[0].label, "HBVM(2,2), 2 s");
  EXPECT_EQ(figure.panels[0].curves[0].points.back()[1], -6);
  EXPECT_EQ(figure.panels[0].curves[2].label, "HBVM(6,2), auto, 3 s");
  ASSERT_EQ(figure.panels[1].curves.size(), 3u);
  EXPECT_EQ(figure.panels[1].curves[0].points.size(), 2u);
  EXPECT_NE(figure.caption.find("t = 100"), std::string::npos);
  EXPECT_EQ(energy_table(drawn_study(), Expression::parse("100"), runs).groups[0].rows.size(), 4u);
}

TEST(ConservingFigure, ComparesWithAsManyNodesAsStages) {
  std::vector<EnergyCost> runs;
  for (const char* const precision : {"double", "mpfr:40"}) {
    runs.push_back(energy_run_of("hbvm:1,1", precision, 2, -3));
    runs.push_back(energy_run_of("hbvm:3,1", precision, 3, -9));
    runs.push_back(energy_run_of("hbvm:2,2", precision, 4, -5));
  }
  const Figure figure = conserving_figure(drawn_study(), runs);
  ASSERT_EQ(figure.panels.size(), 3u);
  ASSERT_EQ(figure.panels[0].curves.size(), 2u);
  EXPECT_EQ(figure.panels[0].curves[0].label, "s = 1");
  EXPECT_EQ(figure.panels[0].curves[0].points, (std::vector<PlotPoint>{{1, 1}, {3, 1.5}}));
  EXPECT_EQ(figure.panels[2].curves[0].points, (std::vector<PlotPoint>{{1, -3}, {3, -9}}));
}

}  // namespace
}  // namespace hbvm::core
