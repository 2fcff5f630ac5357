#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(MultistepSchemes, HaveTheirOrders) {
  EXPECT_EQ(order_of("alpha = ['1/3','-4/3',1]\nbeta = [0,0,'2/3']\n"), 2);            // BDF2
  EXPECT_EQ(order_of("alpha = [0,0,-1,1]\nbeta = ['5/12','-16/12','23/12',0]\n"), 3);  // Adams-Bashforth
  EXPECT_EQ(order_of("alpha = [-1,0,1]\nbeta = ['1/3','4/3','1/3']\n"), 4);            // Milne
  EXPECT_EQ(order_of("alpha = [0,0,-1,1]\nbeta = ['5/12','-15/12','23/12',0]\n"), 0);
}

TEST(MultistepSchemes, NeedTwoNumbers) {
  expect_words(message_of([] { scheme_of("alpha = [1]\nbeta = [1]\n"); }), {"alpha has one number"});
}

}  // namespace
}  // namespace hbvm::core
