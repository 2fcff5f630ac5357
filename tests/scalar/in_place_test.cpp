#include "hbvm/scalar/in_place.hpp"

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm {
namespace {

template <class S>
class InPlace : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
  RandomValues<S> random{7};
  S a = random.value(), b = random.value(), r = random.value(), t;
};
TYPED_TEST_SUITE(InPlace, AllScalars, ScalarNames);

TYPED_TEST(InPlace, AgreesWithTheOperators) {
  const TypeParam x = this->a, y = this->b;
  TypeParam z = this->r;
  set(z, x);
  EXPECT_EQ(z, x);
  set_sum(z, x, y);
  EXPECT_EQ(z, x + y);
  set_difference(z, x, y);
  EXPECT_EQ(z, x - y);
  set_negative(z, x);
  EXPECT_EQ(z, -x);
  set_product(z, x, y);
  EXPECT_EQ(z, x * y);
  set_quotient(z, x, y);
  EXPECT_EQ(z, x / y);
  set_zero(z);
  EXPECT_EQ(z, 0);
}

TYPED_TEST(InPlace, ProductsAreRoundedBeforeTheyAreAdded) {
  const TypeParam before = this->r, product = this->a * this->b;
  add_product(this->r, this->a, this->b, this->t);
  EXPECT_EQ(this->r, before + product);
  this->r = before;
  subtract_product(this->r, this->a, this->b, this->t);
  EXPECT_EQ(this->r, before - product);
}

TYPED_TEST(InPlace, ResultMayBeAnOperand) {
  const TypeParam x = this->a, y = this->b;
  TypeParam z = x;
  set_difference(z, y, z);
  EXPECT_EQ(z, y - x);
  z = x;
  set_quotient(z, y, z);
  EXPECT_EQ(z, y / x);
  z = x;
  add_product(z, z, z, this->t);
  EXPECT_EQ(z, x + x * x);
}

}  // namespace
}  // namespace hbvm
