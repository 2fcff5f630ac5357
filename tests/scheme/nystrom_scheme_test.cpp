#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

TEST(NystromSchemes, OfAccelerationsHaveOrder4) {
  EXPECT_EQ(order_of(nystrom_4), 4);
  std::string wrong = nystrom_4;
  wrong.replace(wrong.find("1/8"), 3, "1/9");
  EXPECT_EQ(order_of(wrong), 2);
}

/// RK4 on q' = v, v' = f(q, v) is one of these, with A = A_hat^2 and b = b_hat A_hat.
TEST(NystromSchemes, OfForcesWithVelocityHaveTheOrderOfTheirRungeKuttaMethod) {
  EXPECT_EQ(
      order_of("family = 'nystrom'\nc = [0,'1/2','1/2',1]\nA_hat = [[0,0,0,0],['1/2',0,0,0],[0,'1/2',0,0],[0,0,1,0]]\n"
               "A = [[0,0,0,0],[0,0,0,0],['1/4',0,0,0],[0,'1/2',0,0]]\nb = ['1/6','1/6','1/6',0]\n"
               "b_hat = ['1/6','1/3','1/3','1/6']\n"),
      4);
}

}  // namespace
}  // namespace hbvm::core
