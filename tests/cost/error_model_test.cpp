#include "cost/error_model.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(ErrorModel, IsThePowerOfItsOrder) {
  const ErrorModel model{8, std::log10(2.5), 3};
  const double h = std::log10(0.1);
  EXPECT_NEAR(model.digits(h), 8 * std::log10(25) - 3, 1e-12);
  // Half of the step, 2^8 times less.
  EXPECT_NEAR(model.digits(h - std::log10(2)) - model.digits(h), 8 * std::log10(2), 1e-12);
}

TEST(ErrorModel, FindsTheStepForDigits) {
  const ErrorModel model{12, 0.3, 1.5};
  for (const double digits : {2., 30., 700.}) EXPECT_NEAR(model.digits(model.log10_step(digits)), digits, 1e-9);
}

TEST(ErrorModel, LearnsFromARun) {
  const ErrorModel learnt = ErrorModel{6, 0, 2}.corrected(-1.25, 4.5);
  EXPECT_NEAR(learnt.digits(-1.25), 4.5, 1e-12);
  EXPECT_EQ(learnt.order, 6);
  EXPECT_EQ(learnt.lost, 2);
}

}  // namespace
}  // namespace hbvm::core
