#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cost/cost_report.hpp"
#include "cost/findings.hpp"

namespace hbvm::core {
namespace {

const Curve* curve_named(const Panel& panel, const std::string& start) {
  for (const Curve& curve : panel.curves)
    if (curve.label.starts_with(start)) return &curve;
  return nullptr;
}

TEST(WorkPrecisionFigure, HasAPanelAPrecisionAndOneOfAll) {
  const Given given = some_findings();
  const Figure figure = work_precision_figure(given.study, given.outcome);
  ASSERT_EQ(figure.panels.size(), 3u);
  EXPECT_EQ(figure.panels[1].title, "double");
  const Curve* const gauss = curve_named(figure.panels[1], "HBVM(4,4), order 8");
  ASSERT_TRUE(gauss);
  EXPECT_EQ(gauss->points, (std::vector<PlotPoint>{{6, std::log10(0.02)}, {9, std::log10(0.04)}}));
  ASSERT_TRUE(curve_named(figure.panels[1], "RATTLE, order 2"));
  // The front leaves out what is both slower and less precise.
  ASSERT_EQ(figure.panels[1].lines.size(), 1u);
  EXPECT_EQ(figure.panels[1].lines[0].points.size(), 3u);
  EXPECT_EQ(figure.panels[0].curves.size(), 2u);
}

TEST(WorkPrecisionFigure, ShowsEveryFamilyAndNotTooManyCurves) {
  Given given = some_findings();
  for (int s = 2; s <= 20; ++s)
    for (const long steps : {10, 20}) {
      const std::string method = "hbvm:" + std::to_string(s) + "," + std::to_string(s);
      given.add(method.c_str(), "double", steps, 1 + s / 4.0, 0.001 * static_cast<double>(steps));
    }
  std::stable_sort(given.outcome.findings.begin(), given.outcome.findings.end(),
                   [](const auto& a, const auto& b) { return a.cell.precision.digits() < b.cell.precision.digits(); });
  const Figure figure = work_precision_figure(given.study, given.outcome);
  EXPECT_LE(figure.panels[1].curves.size(), 9u);
  EXPECT_TRUE(curve_named(figure.panels[1], "RATTLE"));
}

TEST(DigitsFigure, TellsWhatIsPropagatedFromTheOutputState) {
  const Given given = some_findings();
  const Figure figure = digits_figure(given.study, given.outcome);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_TRUE(curve_named(figure.panels[0], "RATTLE"));
  const Curve *const output = curve_named(figure.panels[1], "p, output"), *const raw = curve_named(figure.panels[1],
                                                                                                   "p, propagated");
  ASSERT_TRUE(output && raw);
  EXPECT_EQ(output->points.back()[0], 16);
  EXPECT_EQ(raw->points.back()[0], 7.5);
}

}  // namespace
}  // namespace hbvm::core
