#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

TEST(CompositionSchemes, OfSymmetricSteps) {
  EXPECT_EQ(order_of("gamma = ['1/(2-2^(1/3))', '-2^(1/3)/(2-2^(1/3))', '1/(2-2^(1/3))']\n"), 4);
  // Suzuki's of five steps.
  EXPECT_EQ(
      order_of(
          "gamma = ['1/(4-4^(1/3))', '1/(4-4^(1/3))', '-4^(1/3)/(4-4^(1/3))', '1/(4-4^(1/3))', '1/(4-4^(1/3))']\n"),
      4);
  EXPECT_EQ(order_of(yoshida_6), 6);
}

TEST(CompositionSchemes, OfAMethodAndItsAdjoint) {
  EXPECT_EQ(order_of("family = 'composition'\nalpha = ['1/2']\nbeta = ['1/2']\n"), 2);
  EXPECT_EQ(order_of("family = 'composition'\nalpha = ['1/3']\nbeta = ['2/3']\n"), 1);
}

}  // namespace
}  // namespace hbvm::core
