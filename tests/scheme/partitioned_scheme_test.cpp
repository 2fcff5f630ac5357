#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

TEST(PartitionedSchemes, HaveAnOrderForSeparateAndOneForCoupledEquations) {
  EXPECT_EQ(order_of(lobatto_pair, 0), 4);
  EXPECT_EQ(order_of(lobatto_pair, 1), 4);
  // Verlet's method, and symplectic Euler.
  const std::string verlet =
      "A = [[0,0],['1/2','1/2']]\nb = ['1/2','1/2']\nA_hat = [['1/2',0],['1/2',0]]\nb_hat = ['1/2','1/2']\n";
  EXPECT_EQ(order_of(verlet, 0), 2);
  EXPECT_EQ(order_of(verlet, 1), 2);
  EXPECT_EQ(order_of("A = [[1]]\nb = [1]\nA_hat = [[0]]\nb_hat = [1]\n", 1), 1);
}

/// Two methods of order 4 need not fit each other: a first-order coupling shows.
TEST(PartitionedSchemes, SeeWhetherTheTwoFit) {
  const std::string rk4 = "[[0,0,0,0],['1/2',0,0,0],[0,'1/2',0,0],[0,0,1,0]]",
                    rk38 = "[[0,0,0,0],['1/3',0,0,0],['-1/3',1,0,0],[1,-1,1,0]]";
  const std::string both = "A = " + rk4 + "\nb = ['1/6','1/3','1/3','1/6']\nA_hat = ";
  EXPECT_EQ(order_of(both + rk4 + "\nb_hat = ['1/6','1/3','1/3','1/6']\n", 1), 4);
  EXPECT_LT(order_of(both + rk38 + "\nb_hat = ['1/8','3/8','3/8','1/8']\n", 1), 4);
  EXPECT_EQ(order_of(both + rk38 + "\nb_hat = ['1/8','3/8','3/8','1/8']\n", 0), 2);
}

}  // namespace
}  // namespace hbvm::core
