#include "scalar/in_place.hpp"

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class InPlace : public InDigits<50> {
 protected:
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

/// Exactly, `of` being what MPFR makes of x and y.
template <Scalar S>
bool is_sum_of(const S& value, const S& rest, int (*of)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), const S& x,
               const S& y) {
  BigFloat all(2000), parts(2000);
  of(raw(all), raw(exactly(x)), raw(exactly(y)), MPFR_RNDN);
  mpfr_add(raw(parts), raw(exactly(value)), raw(exactly(rest)), MPFR_RNDN);
  return mpfr_cmp(raw(all), raw(parts)) == 0;
}

TYPED_TEST(InPlace, ExactSumKeepsWhatRoundingTakes) {
  using S = TypeParam;
  for (const int shift : {-200, -40, -1, 0, 1, 40, 200}) {
    const S x = this->random.value(), y = this->random.value() * power_of_two<S>(shift);
    S sum, rest;
    set_exact_sum(sum, rest, x, y, this->t);
    EXPECT_EQ(sum, S(x + y));
    EXPECT_TRUE(is_sum_of(sum, rest, mpfr_add, x, y)) << "2^" << shift;
  }
}

TYPED_TEST(InPlace, ExactProductKeepsWhatRoundingTakes) {
  using S = TypeParam;
  if constexpr (!std::same_as<S, Quad>)
    for (int i = 0; i < 20; ++i) {
      const S x = this->random.value(), y = this->random.value();
      S product, rest;
      set_exact_product(product, rest, x, y);
      EXPECT_EQ(product, S(x * y));
      EXPECT_TRUE(is_sum_of(product, rest, mpfr_mul, x, y)) << x << " * " << y;
    }
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
}  // namespace hbvm::core
