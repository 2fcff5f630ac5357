#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

/// Calahan's method of two stages, 1968.
TEST(RosenbrockSchemes, OfTwoStagesHaveOrder3) {
  EXPECT_EQ(order_of(calahan), 3);
  std::string wrong = calahan;
  wrong.replace(wrong.find("-4/3*"), 5, "-4/5*");
  EXPECT_EQ(order_of(wrong), 1);
}

TEST(RosenbrockSchemes, WithoutGammaAreRungeKuttaMethods) {
  EXPECT_EQ(order_of("alpha = [[0,0,0,0],['1/2',0,0,0],[0,'1/2',0,0],[0,0,1,0]]\n"
                     "gamma = [[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]\nb = ['1/6','1/3','1/3','1/6']\n"
                     "b_hat = [1,0,0,0]\n"),
            4);
}

}  // namespace
}  // namespace hbvm::core
