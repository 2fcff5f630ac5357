#include "reference/proof/hex_number.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

double back(std::string_view text) {
  const std::optional<RealBall> x = number_of_hex(text);
  return x ? centre_of(raw(*x)) : -999;
}

TEST(HexNumber, IsExactThereAndBack) {
  for (const double x : {0.0, 1.0, -0.1, 1e300, -4.9e-324, 12345.0}) EXPECT_EQ(back(hex_text(x)), x);
  const BallScope bits(1'000);
  const RealBall third = RealBall(1) / RealBall(3);
  RealBall centre;
  arb_get_mid_arb(raw(centre), raw(third));
  EXPECT_NE(arb_equal(raw(*number_of_hex(hex_text(third))), raw(centre)), 0);
}

TEST(HexNumber, IsMantissaTimesAPowerOfTwo) {
  EXPECT_EQ(back("3p1"), 6);
  EXPECT_EQ(back("-1a3p-4"), -0x1a3 / 16.0);
  EXPECT_EQ(hex_text(6.0), "3p1");
}

TEST(HexNumber, IsNoOtherText) {
  for (const char* text : {"", "1", "p", "1p", "p1", "1p1p1", "0x1p1", "1.5p1", "nanp0", "1p1000000", "1p-1000000",
                           "1 p1", "--1p0", "1p0 "})
    EXPECT_EQ(back(text), -999) << text;
}

}  // namespace
}  // namespace hbvm::core
