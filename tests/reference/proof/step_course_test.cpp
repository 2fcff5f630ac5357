#include "reference/proof/step_course.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hbvm::core {
namespace {

double value(const RealBall& x) { return centre_of(raw(x)); }

StepCourse::Piece piece(double end, double omega, double rate, double defect, double tube) {
  return {exact_ball(end), omega, exact_ball(rate), exact_ball(defect), exact_ball(tube)};
}

TEST(StepCourse, ADistanceGrowsByItsRateAndTheDefect) {
  const StepCourse course{{piece(1, 2, 3, 0.5, 1e9)}, exact_ball(0.25), 0};
  const ErrorDistance end = course.distance_at(RealBall(1), {exact_ball(7), 2});
  // e^(3/4) (7 + 1/8), little more than the solution of r' = 3 r + 1/2.
  EXPECT_NEAR(value(end.length), std::exp(0.75) * 7.125, 1e-12);
  EXPECT_GE(value(end.length), std::exp(0.75) * (7 + 0.5 / 3) - 0.5 / 3);
  EXPECT_EQ(end.omega, 2);
  EXPECT_NEAR(value(course.distance_at(exact_ball(0.5), {exact_ball(7), 2}).length), std::exp(0.375) * 7.0625, 1e-12);
}

/// With a negative rate the start fades, and what the defect adds does not vanish.
TEST(StepCourse, ADefectStaysWhereErrorsFade) {
  const StepCourse course{{piece(1, 1, -100, 0.5, 1e9)}, RealBall(1), 0};
  EXPECT_NEAR(value(course.distance_at(RealBall(1), {RealBall(1), 1}).length), 0.5, 1e-12);
}

TEST(StepCourse, AHigherRateOfMeasuringMakesAnErrorLonger) {
  const ErrorDistance error{RealBall(3), 2};
  EXPECT_EQ(value(error.measured_by(1).length), 3);
  EXPECT_EQ(value(error.measured_by(8).length), 12);
  const StepCourse course{{piece(0.5, 2, 0, 0, 1e9), piece(1, 8, 0, 0, 1e9)}, RealBall(1), 0};
  EXPECT_EQ(value(course.distance_at(exact_ball(0.25), error).length), 3);
  EXPECT_EQ(value(course.distance_at(RealBall(1), error).length), 12);
}

TEST(StepCourse, ATubeIsLeftByOnePieceAlone) {
  const auto stays = [](double tube) {
    const StepCourse course{{piece(0.5, 1, 4, 0, tube), piece(1, 1, -4, 0, tube)}, RealBall(1), 0};
    return course.stays_in_tube({RealBall(1), 1});
  };
  // In the middle it is e^2.
  EXPECT_TRUE(stays(7.4));
  EXPECT_FALSE(stays(7.3));
  EXPECT_FALSE(stays(std::nan("")));
}

}  // namespace
}  // namespace hbvm::core
