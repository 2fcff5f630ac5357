#include "cost/step_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cost/cost_methods.hpp"
#include "hbvm/error.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

CostStudy study_of_steps() {
  CostStudy study{load_scene("double_pendulum"), Expression::parse("10")};
  study.methods = cost_methods({"hbvm:4,4", "hbvm:3,3", "rattle"}, 30);
  return study;
}

TEST(StepTime, IsAskedOfSomeMethodsInEveryPrecision) {
  const MotionNature nature{1, 0};
  const std::vector<CostCell> cells = step_time_cells(study_of_steps(), nature);
  ASSERT_EQ(cells.size(), 18u);
  EXPECT_EQ(cells[0].method->text(), "hbvm:4,4");
  EXPECT_EQ(cells[0].precision.name(), "double");
  EXPECT_EQ(cells.back().precision.name(), "mpfr:1000");
  // Quarters of a radius of 1.
  EXPECT_EQ(cells[0].steps, 40);
}

TEST(StepTime, IsMeasuredWithTheOperationsThatGrowWithTheStages) {
  const CostStudy study = study_of_steps();
  const auto measured = [&](const char* method, const char* precision) {
    const CostCell cell{parse_method(method), Precision::parse(precision), 40};
    const StepTime time = read_step_time(cell, measure_step_time(study, cell));
    EXPECT_EQ(time.failure, "");
    EXPECT_GT(time.seconds, 0);
    return time;
  };
  EXPECT_GT(measured("hbvm:4,4", "double").operations, 0);
  EXPECT_GT(measured("hbvm:4,4", "mpfr:1000").operations, measured("hbvm:4,4", "mpfr:100").operations);
  EXPECT_GT(measured("hbvm:16,16", "mpfr:100").operations, 4 * measured("hbvm:4,4", "mpfr:100").operations);
}

/// RATTLE has no step of 2 for the conical pendulum.
TEST(StepTime, IsThatOfAStepWhichTheMethodCanMake) {
  const CostStudy study{load_scene("conical_pendulum"), Expression::parse("10")};
  const CostCell cell{parse_method("rattle"), Precision::parse("double"), 5};
  const StepTime time = read_step_time(cell, measure_step_time(study, cell));
  EXPECT_EQ(time.failure, "");
  EXPECT_GT(time.seconds, 0);
  EXPECT_GE(time.cell.steps, 10);
  EXPECT_LE(time.cell.steps, 40);
}

TEST(StepTime, IsDrawnAgainstTheDigits) {
  CostStudy study = study_of_steps();
  std::vector<StepTime> times;
  for (const CostCell& cell : step_time_cells(study, MotionNature{1, 0})) {
    times.push_back({cell});
    times.back().seconds = cell.precision.name() == "quad" ? 3 : cell.precision.digits();
  }
  times.front().failure = "none";
  const Figure figure = step_time_figure(study, times);
  ASSERT_EQ(figure.panels.size(), 2u);
  ASSERT_EQ(figure.panels[0].curves.size(), 2u);
  EXPECT_EQ(figure.panels[0].curves[0].points.size(), 7u);
  EXPECT_EQ(figure.panels[0].curves[0].points[0], (PlotPoint{std::log10(20), std::log10(20)}));
  EXPECT_EQ(figure.panels[0].marks.size(), 3u) << "double and quad, but for what failed";
  ASSERT_EQ(figure.panels[1].bars.size(), 2u);
  EXPECT_DOUBLE_EQ(figure.panels[1].bars[0].to, 300 / double{34});
  EXPECT_EQ(step_time_table(study, times).groups[0].rows.size(), 17u);
}

TEST(StepTime, IsReadFromItsOwnResultsAlone) {
  const CostCell cell{parse_method("rattle"), Precision::parse("double"), 1};
  EXPECT_EQ(read_step_time(cell, R"({"failure": "why"})").failure, "why");
  const StepTime time = read_step_time(cell, R"({"failure": "", "steps": 4, "seconds": 2, "operations": 1})");
  EXPECT_EQ(time.cell.steps, 4);
  EXPECT_THROW(read_step_time(cell, "{}"), InputError);
  EXPECT_THROW(read_step_time(cell, R"({"failure": "", "seconds": 2, "operations": 1})"), InputError);
}

}  // namespace
}  // namespace hbvm::core
