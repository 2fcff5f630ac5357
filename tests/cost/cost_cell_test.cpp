#include "cost/cost_cell.hpp"

#include <gtest/gtest.h>

#include "cost/cost_reference.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

const Expression ten = Expression::parse("10");

CostJudge judge_of(const Scene& scene) {
  const CostReference reference = find_cost_reference({.scene = &scene, .until = ten, .digits = 50});
  return {scene, reference.state, reference.digits};
}

CostMeasurement measured(const Scene& scene, const CostJudge& judge, const char* method, const char* precision,
                         long steps) {
  return measure_cost(scene, ten, {parse_method(method), Precision::parse(precision), steps}, judge, {1, 2, 0.01});
}

TEST(CostCell, FindsTheOrdersOfWhatIsPropagatedAndOfTheOutputState) {
  const Scene scene = load_scene("modified_pendulum");
  const CostJudge judge = judge_of(scene);
  const CostMeasurement coarse = measured(scene, judge, "hbvm:2,2", "quad", 256),
                        fine = measured(scene, judge, "hbvm:2,2", "quad", 512);
  constexpr double octave = 0.30103;
  EXPECT_NEAR((coarse.errors.q - fine.errors.q) / octave, 4, 0.3);
  EXPECT_NEAR((coarse.errors.p - fine.errors.p) / octave, 4, 0.3);
  EXPECT_NEAR((coarse.errors.lambda - fine.errors.lambda) / octave, 4, 0.3);
  EXPECT_NEAR((coarse.raw.p - fine.raw.p) / octave, 2, 0.3);
  EXPECT_LT((coarse.raw.lambda - fine.raw.lambda) / octave, 2.3);
  EXPECT_GT(fine.operations, coarse.operations);
  EXPECT_GT(fine.seconds, 0);
  EXPECT_GT(fine.calibration, 0);
}

TEST(CostCell, IsTheSameAgainButForTimes) {
  const Scene scene = load_scene("double_pendulum");
  const CostJudge judge = judge_of(scene);
  const CostMeasurement one = measured(scene, judge, "hbvm:auto,3", "double", 200),
                        other = measured(scene, judge, "hbvm:auto,3", "double", 200);
  EXPECT_EQ(one.method, other.method);
  EXPECT_NE(one.method, "hbvm:auto,3");
  EXPECT_EQ(one.errors.q, other.errors.q);
  EXPECT_EQ(one.operations, other.operations);
  EXPECT_EQ(one.sweeps, other.sweeps);
  EXPECT_EQ(one.evaluations, other.evaluations);
  EXPECT_EQ(one.bytes, other.bytes);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose heaps say nothing
TEST(CostCell, HoldsMoreInMoreDigits) {
  const Scene scene = load_scene("double_pendulum");
  const CostJudge judge = judge_of(scene);
  const long few = measured(scene, judge, "rattle", "mpfr:50", 100).bytes,
             many = measured(scene, judge, "rattle", "mpfr:500", 100).bytes;
  EXPECT_GT(few, 2'000);
  EXPECT_GT(many, few);
  EXPECT_LT(many, 10 * few);
}
#endif

TEST(CostCell, SaysWhyThereIsNoEnd) {
  const Scene scene = load_scene("double_pendulum");
  const CostJudge judge = judge_of(scene);
  const CostMeasurement m = measured(scene, judge, "rattle", "double", 2);
  EXPECT_NE(m.failure, "");
  EXPECT_EQ(read_cost_measurement(to_result(m)).failure, m.failure);
}

TEST(CostCell, NamesItsStepExactly) {
  EXPECT_EQ(step_text(ten, 40), "1/4");
  EXPECT_EQ(step_text(ten, 5), "2");
  EXPECT_EQ(step_text(ten, 3), "10/3");
  EXPECT_EQ(step_text(Expression::parse("2*pi"), 64), "(2*pi)/64");
}

TEST(CostSample, CountsTheOperationsOfAStep) {
  const Scene scene = load_scene("double_pendulum");
  const CostCell cell{parse_method("rattle"), Precision::parse("double"), 1'000};
  const CostSample sample = sample_cost(scene, ten, cell, 8, 1);
  EXPECT_EQ(sample.failure, "");
  EXPECT_EQ(sample.steps, 8);
  EXPECT_GT(sample.operations, 50);
  EXPECT_LT(sample.operations, 5'000);
  EXPECT_EQ(sample.operations_in_double, 0);
}

}  // namespace
}  // namespace hbvm::core
