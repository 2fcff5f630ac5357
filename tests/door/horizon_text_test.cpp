#include "door/horizon_text.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(HorizonText, SaysWhenNoDigitIsLeft) {
  EXPECT_EQ(line_of({"double", 15, 124.25, false}, ": for a reason"), "  double     has no digit left at t = 124.2\n");
  EXPECT_EQ(line_of({"mpfr:34", 34, 272.0, true}, ""), "  mpfr:34    has no digit left at t = 272, if it goes on so\n");
  EXPECT_EQ(line_of({"mpfr:34", 34, {}, false}, ": for a reason"), "  mpfr:34    keeps digits: for a reason\n");
  EXPECT_TRUE(json_of(Horizon{"double", 15, {}, false}).at("t").is_null());
  EXPECT_EQ(json_of(Horizon{"double", 15, 3.5, true}).at("t"), 3.5);
}

}  // namespace
}  // namespace hbvm::core
