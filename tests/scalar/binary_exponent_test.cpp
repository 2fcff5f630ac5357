#include "scalar/binary_exponent.hpp"

#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class BinaryExponent : public InDigits<50> {};
TYPED_TEST_SUITE(BinaryExponent, AllScalars, ScalarNames);

TYPED_TEST(BinaryExponent, IsThatOfThePowerJustAbove) {
  using S = TypeParam;
  S power = 1;
  for (long e = 0; e < 900; ++e, power = power * 2) {
    EXPECT_EQ(power_of_two<S>(e), power);
    EXPECT_EQ(power_of_two<S>(-e), S(1 / power));
    EXPECT_EQ(binary_exponent(power), e + 1);
    EXPECT_EQ(binary_exponent(S(-power)), e + 1);
    EXPECT_EQ(binary_exponent(S(1 / power)), 1 - e);
    EXPECT_EQ(binary_exponent(S(power * (2 - 2 * epsilon<S>()))), e + 1);
    EXPECT_EQ(binary_exponent(S(power * (1 - epsilon<S>() / 2))), e);
  }
}

TYPED_TEST(BinaryExponent, OfZeroIsLessThanAnyOther) {
  using S = TypeParam;
  EXPECT_EQ(binary_exponent(S(0)), exponent_of_zero);
  EXPECT_LT(exponent_of_zero, binary_exponent(power_of_two<S>(-1000)));
}

}  // namespace
}  // namespace hbvm::core
