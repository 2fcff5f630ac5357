#include "scheme/met_orders.hpp"

#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

TEST(MetOrders, OfDecimalsAreMetToTheirDigits) {
  const auto parts = [](const char* a) {
    return parts_of(
        *scheme_of(std::string("A = [['0.25', '") + a + "'], ['0.53867513459481288', '0.25']]\nb = ['0.5', '0.5']\n"));
  };
  const MetPart right = parts("-0.03867513459481288").at(0), wrong = parts("-0.03867513549481288").at(0);
  EXPECT_EQ(right.order, 4);
  EXPECT_GT(right.each.at(3).digits, 15.5);
  EXPECT_LT(right.each.at(3).digits, 18.5);
  // Digits that were exchanged in the ninth place.
  EXPECT_EQ(wrong.order, 1);
  EXPECT_NEAR(wrong.each.at(1).digits, 9.05, 0.1);
  EXPECT_EQ(wrong.each.size(), 2u);
}

TEST(MetOrders, OfExactNumbersAreMetToAllDigitsOrNot) {
  const SchemePtr scheme = scheme_of("A = [[0,0],['1/2+1e-60',0]]\nb = [0,1]\norder = 2\n");
  const Rounding rounding = Rounding::of(*scheme, {});
  EXPECT_EQ(rounding.digits, 0);
  const MetPart part = parts_of(*scheme).at(0);
  EXPECT_EQ(part.order, 1);
  EXPECT_NEAR(part.each.at(1).digits, 59.7, 0.1);
  // What is stated is told, also beyond the first order that is not met.
  EXPECT_EQ(parts_of(*scheme_of("A = [[0,0],['1/3',0]]\nb = [0,1]\norder = 3\n")).at(0).each.size(), 3u);
}

TEST(MetOrders, OfTwoDigitsArePoor) {
  const PrecisionScope scope(30);
  EXPECT_EQ(digits_met({}), 30);
  EXPECT_NEAR(digits_met({Mpfr("0.01"), Mpfr("-0.001")}), 2, 1e-12);
}

}  // namespace
}  // namespace hbvm::core
