#include "study/convergence_figure.hpp"

#include <gtest/gtest.h>

#include "runs/request_of.hpp"

namespace hbvm::core {
namespace {

/// Without constraints q and p: a curve a method, and for each order that was found a triangle.
TEST(ConvergenceFigure, HasACurveAMethodWithItsSlope) {
  const ConvergenceWork work{request_of(load_scene("kepler"), "rattle", "1", "1"),
                             named_methods({"rattle", "rk4"}),
                             {Precision::parse("mpfr:30")},
                             halved_steps("1/8:1/128", {})};
  std::vector<MeasuredConvergence> measured = measure_convergence(work);
  const Figure figure = convergence_figure(work, measured, "hbvm convergence");
  ASSERT_EQ(figure.panels.size(), 2u);
  const Panel& panel = figure.panels[0];
  ASSERT_EQ(panel.curves.size(), 2u);
  EXPECT_EQ(panel.curves[1].points.size(), 5u);
  EXPECT_EQ(panel.curves[1].label, "rk4");
  EXPECT_EQ(panel.x.scale, AxisScale::binary);
  ASSERT_EQ(panel.labels.size(), 2u);
  EXPECT_EQ(panel.labels[0].text, "2");
  EXPECT_EQ(panel.labels[1].text, "4");
  measured[1].rates[0].reset();
  EXPECT_EQ(convergence_figure(work, measured, "").panels[0].labels.size(), 1u);
}

TEST(ConvergenceFigure, HasATriangleForMethodsOfOneOrder) {
  const ConvergenceWork work{request_of(load_scene("kepler"), "rattle", "1", "1"),
                             named_methods({"gauss:2", "rk4"}),
                             {Precision::parse("mpfr:30")},
                             halved_steps("1/8:1/128", {})};
  const Panel panel = convergence_figure(work, measure_convergence(work), "").panels[0];
  EXPECT_EQ(panel.curves[0].label, "gauss:2");
  ASSERT_EQ(panel.labels.size(), 1u);
  EXPECT_EQ(panel.labels[0].text, "4");
}

}  // namespace
}  // namespace hbvm::core
