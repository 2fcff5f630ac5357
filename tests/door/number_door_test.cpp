#include <gtest/gtest.h>

#include <limits>

#include "hbvm/error.hpp"
#include "hbvm/number.hpp"

namespace hbvm {
namespace {

TEST(Number, IsTheDecimalThatWasMeant) {
  EXPECT_EQ(Number(0.1).text(), "0.1");
  EXPECT_EQ(Number(-3).text(), "-3");
  EXPECT_EQ(Number(1e300).text(), "1e+300");
  EXPECT_EQ(Number("2^(3/4)*pi/40").text(), "2^(3/4)*pi/40");
}

TEST(Number, IsFinite) {
  EXPECT_THROW(static_cast<void>(Number(std::numeric_limits<double>::quiet_NaN())), InputError);
  EXPECT_THROW(static_cast<void>(Number(std::numeric_limits<double>::infinity())), InputError);
}

TEST(Number, HasADecimalInEachPrecision) {
  EXPECT_EQ(decimal("5/2"), "2.5");
  EXPECT_EQ(decimal("pi"), "3.141592653589793");
  EXPECT_EQ(decimal("1/3", "mpfr:30").substr(0, 32), "0.333333333333333333333333333333");
  EXPECT_THROW(decimal("1/0"), InputError);
  EXPECT_THROW(decimal("2*"), InputError);
}

}  // namespace
}  // namespace hbvm
