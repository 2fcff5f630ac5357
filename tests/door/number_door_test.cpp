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

}  // namespace
}  // namespace hbvm
