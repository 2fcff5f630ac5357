#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hbvm/order.hpp"

namespace hbvm {
namespace {

/// Errors C h^4 (1 + h) at steps 1/2 ... 2^-n, with a floor of 2^-40.
std::vector<StepError> ladder(int n) {
  std::vector<StepError> steps;
  for (int i = 1; i <= n; ++i) steps.push_back({-1.0 * i, -4.0 * i + std::log2(1 + std::exp2(-i)), -40});
  return steps;
}

TEST(DoorOrder, IsThatOfTheErrorsAboveTheirFloors) {
  const std::optional<MeasuredRate> rate = measured_rate(ladder(9));
  ASSERT_TRUE(rate);
  EXPECT_NEAR(rate->value, 4, rate->uncertainty);
  EXPECT_LT(rate->uncertainty, 0.1);
  std::vector<StepError> with_round_off = ladder(14);
  for (StepError& step : with_round_off) step.error = std::max(step.error, -41.0);
  const std::optional<MeasuredRate> above = measured_rate(with_round_off);
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->value, 4, above->uncertainty);
  EXPECT_LT(above->uncertainty, 0.1);
}

TEST(DoorOrder, IsNotKnownByFourErrors) { EXPECT_FALSE(measured_rate(ladder(4))); }

TEST(DoorOrder, HasTheVerdictOfTheAudit) {
  EXPECT_EQ(order_verdict(MeasuredRate{3.98, 0.05}, 4), "holds");
  EXPECT_EQ(order_verdict(MeasuredRate{4.98, 0.05}, 4), "holds");
  EXPECT_EQ(order_verdict(MeasuredRate{2.98, 0.05}, 4), "fails");
  EXPECT_EQ(order_verdict(MeasuredRate{3.5, 1}, 4), "undecidable");
  EXPECT_EQ(order_verdict(std::nullopt, 4), "undecidable");
}

}  // namespace
}  // namespace hbvm
