#include "linear/product.hpp"

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Product : public InDigits<50> {
 protected:
  RandomValues<S> random{23};
};
TYPED_TEST_SUITE(Product, AllScalars, ScalarNames);

template <Scalar S>
Matrix<S> numbered(Index rows, Index columns, int first) {
  Matrix<S> a(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) a(i, j) = S(first++);
  return a;
}

TYPED_TEST(Product, OfWholeNumbersIsExact) {
  Matrix<TypeParam> c, expected(2, 2);
  product(c, numbered<TypeParam>(2, 3, 1), numbered<TypeParam>(3, 2, -2));
  expected << TypeParam(4), TypeParam(10), TypeParam(4), TypeParam(19);
  EXPECT_EQ(c, expected);
}

TYPED_TEST(Product, AgreesWithEntrywiseDotsForEveryShape) {
  Matrix<TypeParam> c;
  for (int rows : {1, 2, 7}) {
    for (int inner : {1, 3, 8}) {
      for (int columns : {1, 4, 5}) {
        const auto a = this->random.matrix(rows, inner), b = this->random.matrix(inner, columns);
        product(c, a, b);
        ASSERT_EQ(c.rows(), rows);
        ASSERT_EQ(c.cols(), columns);
        // Entries are below 1 in magnitude: each of the sums is off by 1/2 eps for a product, inner/2 eps for a sum.
        const TypeParam tolerance = 2 * inner * inner * epsilon<TypeParam>();
        for (int i = 0; i < rows; ++i) {
          for (int j = 0; j < columns; ++j) {
            TypeParam sum = 0;
            for (int l = inner - 1; l >= 0; --l) sum += a(i, l) * b(l, j);
            EXPECT_LE(magnitude(TypeParam(c(i, j) - sum)), tolerance);
          }
        }
      }
    }
  }
}

TYPED_TEST(Product, OverwritesAResultOfTheRightOrAnotherShape) {
  const auto a = this->random.matrix(3, 3), identity = Matrix<TypeParam>(Matrix<TypeParam>::Identity(3, 3));
  for (auto c : {this->random.matrix(3, 3), this->random.matrix(1, 5), Matrix<TypeParam>()}) {
    product(c, a, identity);
    EXPECT_EQ(c, a);
  }
}

TYPED_TEST(Product, OverNoInnerIndexIsZero) {
  Matrix<TypeParam> c = this->random.matrix(2, 3);
  product(c, Matrix<TypeParam>(2, 0), Matrix<TypeParam>(0, 3));
  EXPECT_EQ(c, (Matrix<TypeParam>(Matrix<TypeParam>::Zero(2, 3))));
}

TYPED_TEST(Product, DotSumsTheProducts) {
  Vector<TypeParam> a(3), b(3);
  a << TypeParam(1), TypeParam(-2), TypeParam(3);
  b << TypeParam(4), TypeParam(5), TypeParam(6);
  EXPECT_EQ(dot(a, b), 12);
  EXPECT_EQ(dot(Vector<TypeParam>(0), Vector<TypeParam>(0)), 0);
  const auto x = this->random.vector(20), y = this->random.vector(20);
  TypeParam sum = 0;
  for (int i = 19; i >= 0; --i) sum += x[i] * y[i];
  EXPECT_LE(magnitude(TypeParam(dot(x, y) - sum)), 2 * 20 * 20 * epsilon<TypeParam>());
}

/// sum_i x_i y_i, not rounded.
template <Scalar S>
Mpfr exact_dot(const Vector<S>& x, const Vector<S>& y) {
  Mpfr sum, product;
  for (auto* const z : {&sum, &product}) mpfr_set_prec(raw(*z), 5000);
  mpfr_set_zero(raw(sum), 1);
  for (Index i = 0; i < x.size(); ++i) {
    const BigFloat a = exactly(x[i]), b = exactly(y[i]);
    mpfr_mul(raw(product), raw(a), raw(b), MPFR_RNDN);
    mpfr_add(raw(sum), raw(sum), raw(product), MPFR_RNDN);
  }
  return sum;
}

TYPED_TEST(Product, ADotIsRoundedOnceHoweverMuchCancels) {
  using S = TypeParam;
  if (std::same_as<S, Quad>) return;
  for (const unsigned length : {50u, 600u}) {
    const PrecisionScope scope(length);
    for (int i = 0; i < 30; ++i) {
      // Of the first eleven products some ten bits less than all cancel with the last.
      Vector<S> x(12), y(12);
      for (Index l = 0; l < 11; ++l) x[l] = this->random.value(), y[l] = this->random.value();
      x[i % 11] = 0;
      x[11] = dot(Vector<S>(x.head(11)), Vector<S>(y.head(11))) * (1 + power_of_two<S>(-12 - i));
      y[11] = -1;
      S r;
      set_dot(r, x.data(), 1, y.data(), 1, 12);
      Mpfr error = exact_dot(x, y), bound = error;
      const BigFloat rounded = exactly(r);
      mpfr_sub(raw(error), raw(error), raw(rounded), MPFR_RNDN);
      mpfr_mul_2si(raw(bound), raw(bound), 1 - significand_bits<S>(), MPFR_RNDN);
      EXPECT_LE(mpfr_cmpabs(raw(error), raw(bound)), 0) << i << ", " << length << " digits";
    }
  }
}

TYPED_TEST(Product, ADotOfEntriesThatStandApart) {
  const auto x = this->random.matrix(3, 5), y = this->random.matrix(4, 5);
  TypeParam strided, packed;
  set_dot(strided, x.data() + 2, 3, y.data() + 1, 4, 5);
  const Vector<TypeParam> a = x.row(2), b = y.row(1);
  set_dot(packed, a.data(), 1, b.data(), 1, 5);
  EXPECT_EQ(strided, packed);
  EXPECT_LE(magnitude(TypeParam(strided - dot(a, b))), 2 * 5 * 5 * epsilon<TypeParam>());
  set_dot(packed, a.data(), 1, b.data(), 1, 0);
  EXPECT_EQ(packed, 0);
}

}  // namespace
}  // namespace hbvm::core
