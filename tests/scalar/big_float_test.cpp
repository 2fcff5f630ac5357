#include "scalar/big_float.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "scalar/mpfr.hpp"

namespace hbvm::core {
namespace {

BigFloat third(long bits) {
  BigFloat x(bits);
  mpfr_set_ui(raw(x), 1, MPFR_RNDN);
  mpfr_div_ui(raw(x), raw(x), 3, MPFR_RNDN);
  return x;
}

bool equal(const BigFloat& a, const BigFloat& b) {
  return mpfr_get_prec(raw(a)) == mpfr_get_prec(raw(b)) && mpfr_equal_p(raw(a), raw(b)) != 0;
}

TEST(BigFloat, KeepsItsBitsWhateverTheScope) {
  const PrecisionScope scope(20);
  const BigFloat x = third(777);
  const BigFloat copy = x;
  EXPECT_EQ(mpfr_get_prec(raw(copy)), 777);
  EXPECT_TRUE(equal(copy, x));
}

TEST(BigFloat, AssignmentTakesValueAndBits) {
  const BigFloat x = third(300);
  BigFloat copied(53), moved(53);
  copied = x;
  moved = third(300);
  EXPECT_TRUE(equal(copied, x));
  EXPECT_TRUE(equal(moved, x));
}

TEST(BigFloat, SelfAssignmentKeepsTheValue) {
  BigFloat x = third(300);
  const BigFloat& same = x;
  x = same;
  EXPECT_TRUE(equal(x, third(300)));
}

TEST(BigFloat, SwapsAndMoves) {
  BigFloat a = third(100), b(200);
  mpfr_set_ui(raw(b), 7, MPFR_RNDN);
  std::swap(a, b);
  EXPECT_EQ(mpfr_get_ui(raw(a), MPFR_RNDN), 7u);
  EXPECT_TRUE(equal(b, third(100)));
  const BigFloat c = std::move(b);
  EXPECT_TRUE(equal(c, third(100)));
}

}  // namespace
}  // namespace hbvm::core
