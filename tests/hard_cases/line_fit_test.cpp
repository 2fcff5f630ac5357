#include "hard_cases/line_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hbvm::core {
namespace {

TEST(LineFit, OfALineIsTheLine) {
  const LineFit fit = fit_line({0, 1, 2, 5}, {3, 1, -1, -7});
  EXPECT_DOUBLE_EQ(fit.slope, -2);
  EXPECT_NEAR(fit.standard_error, 0, 1e-15);
  EXPECT_EQ(fit_line({0, 2}, {0, 3}).standard_error, 0);
}

TEST(LineFit, ErrorIsThatOfTheScatter) {
  // By hand: slope 1/2, residuals -1/12 (twice), 1/6 ... over x = -1, 0, 1 twice.
  const LineFit fit = fit_line({-1, 0, 1, -1, 0, 1}, {0, 0, 1, 0, 0, 1});
  EXPECT_DOUBLE_EQ(fit.slope, 0.5);
  EXPECT_DOUBLE_EQ(fit.standard_error, std::sqrt((4 * 1. / 36 + 2 * 4. / 36) / 4 / 4));
}

}  // namespace
}  // namespace hbvm::core
