#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "hbvm/precision.hpp"

namespace hbvm {
namespace {

TEST(DoorPrecision, IsNamedByItsDigits) {
  EXPECT_EQ(precision_name("50"), "mpfr:50");
  EXPECT_EQ(decimal_digits("mpfr:50"), 50);
  EXPECT_EQ(decimal_digits("double"), 15);
  EXPECT_THROW(precision_name("single"), InputError);
  if (has_quad()) {
    EXPECT_EQ(decimal_digits("quad"), 33);
  }
}

}  // namespace
}  // namespace hbvm
