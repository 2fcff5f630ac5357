#include "basis/legendre.hpp"

#include <cmath>

#include "basis/gauss_legendre.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

using std::sqrt;

template <class S>
class Legendre : public InDigits<50> {
 protected:
  static constexpr int count = 12;
  RandomValues<S> random{3};

  /// The recurrence is stable on [0, 1]: every step adds a few ulps of the largest value, sqrt(2 count + 1) <= count.
  S tolerance() const { return S(8 * count * count) * epsilon<S>(); }

  Vector<S> points(int n) {
    Vector<S> c(n);
    for (int i = 0; i < n; ++i) c[i] = magnitude(random.value());
    return c;
  }
};
TYPED_TEST_SUITE(Legendre, AllScalars, ScalarNames);

TYPED_TEST(Legendre, IsOrthonormal) {
  const auto gauss = gauss_legendre<TypeParam>(this->count);
  const Matrix<TypeParam> P = legendre_values<TypeParam>(gauss.c, this->count);
  for (int j = 0; j < this->count; ++j) {
    for (int l = 0; l <= j; ++l) {
      TypeParam sum = 0;
      for (int i = 0; i < this->count; ++i) sum += gauss.b[i] * P(i, j) * P(i, l);
      EXPECT_LE(magnitude(TypeParam(sum - (j == l ? 1 : 0))), this->tolerance()) << j << " " << l;
    }
  }
}

/// Both sides computed; on the right no number is larger than on the left.
TYPED_TEST(Legendre, ContinuesBeyondOne) {
  const Vector<TypeParam> c = this->points(10), later = c.array() + TypeParam(1);
  const Matrix<TypeParam> T = legendre_shift<TypeParam>(this->count),
                          beyond = legendre_values<TypeParam>(later, this->count),
                          sum = legendre_values<TypeParam>(c, this->count).lazyProduct(T);
  for (int j = 0; j < this->count; ++j) {
    for (int i = 0; i < c.size(); ++i)
      EXPECT_LE(magnitude(TypeParam(sum(i, j) - beyond(i, j))), this->tolerance() * T.col(j).maxCoeff())
          << i << " " << j;
    EXPECT_LE(magnitude(TypeParam(T(j, j) - 1)), this->tolerance());
    for (int i = j + 1; i < this->count; ++i) EXPECT_EQ(T(i, j), 0);
  }
}

TYPED_TEST(Legendre, HasItsValuesAtTheEndsAndTheMiddle) {
  Vector<TypeParam> c(3);
  c << TypeParam(0), TypeParam(1) / 2, TypeParam(1);
  const Matrix<TypeParam> P = legendre_values<TypeParam>(c, this->count);
  for (int j = 0; j < this->count; ++j) {
    const TypeParam at_1 = sqrt(TypeParam(2 * j + 1));
    EXPECT_EQ(P(2, j), at_1);
    EXPECT_EQ(P(0, j), j % 2 == 0 ? at_1 : TypeParam(-at_1));
    if (j % 2 == 1) {
      EXPECT_EQ(P(1, j), 0);
    }
  }
}

TYPED_TEST(Legendre, AgreesWithTheWrittenOutPolynomials) {
  const Vector<TypeParam> c = this->points(20) * TypeParam(3);
  const Matrix<TypeParam> P = legendre_values<TypeParam>(c, 4);
  for (int i = 0; i < c.size(); ++i) {
    const TypeParam x = c[i];
    // 3 * 120 bounds the largest term of P_3 at c = 3, from which the rounding errors come.
    const TypeParam tolerance = 2'000 * epsilon<TypeParam>();
    EXPECT_EQ(P(i, 0), 1);
    EXPECT_LE(magnitude(TypeParam(P(i, 1) - sqrt(TypeParam(3)) * (2 * x - 1))), tolerance);
    EXPECT_LE(magnitude(TypeParam(P(i, 2) - sqrt(TypeParam(5)) * (6 * x * x - 6 * x + 1))), tolerance);
    EXPECT_LE(magnitude(TypeParam(P(i, 3) - sqrt(TypeParam(7)) * (20 * x * x * x - 30 * x * x + 12 * x - 1))),
              tolerance);
  }
}

TYPED_TEST(Legendre, IntegralsAgreeWithQuadratureOfTheValues) {
  const Vector<TypeParam> c = this->points(10);
  const Matrix<TypeParam> integrals = legendre_integrals<TypeParam>(c, this->count);
  const auto gauss = gauss_legendre<TypeParam>(this->count);
  for (int i = 0; i < c.size(); ++i) {
    const Matrix<TypeParam> P = legendre_values<TypeParam>(Vector<TypeParam>(gauss.c * c[i]), this->count);
    for (int j = 0; j < this->count; ++j) {
      TypeParam sum = 0;
      for (int l = 0; l < this->count; ++l) sum += c[i] * gauss.b[l] * P(l, j);
      EXPECT_LE(magnitude(TypeParam(integrals(i, j) - sum)), this->tolerance()) << i << " " << j;
    }
  }
}

TYPED_TEST(Legendre, IntegralsAreZeroAtZeroAndDeltaAtOne) {
  Vector<TypeParam> c(2);
  c << TypeParam(0), TypeParam(1);
  const Matrix<TypeParam> integrals = legendre_integrals<TypeParam>(c, this->count);
  for (int j = 0; j < this->count; ++j) {
    EXPECT_LE(magnitude(integrals(0, j)), 2 * epsilon<TypeParam>());
    EXPECT_LE(magnitude(TypeParam(integrals(1, j) - (j == 0 ? 1 : 0))), 2 * epsilon<TypeParam>());
  }
}

TEST(LegendreIntegrals, HaveTheValuesAsDerivatives) {
  const PrecisionScope digits(60);
  const Mpfr h = literal<Mpfr>("1e-20");
  RandomValues<Mpfr> random(9);
  constexpr int count = 10;
  Vector<Mpfr> c = random.vector(10), left = c, right = c;
  for (int i = 0; i < c.size(); ++i) {
    left[i] -= h;
    right[i] += h;
  }
  const Matrix<Mpfr> P = legendre_values<Mpfr>(c, count), before = legendre_integrals<Mpfr>(left, count),
                     after = legendre_integrals<Mpfr>(right, count);
  // The c_i may be negative, where P_9 reaches 4 * 10^7: h^2/6 P'' and eps/h stay below 10^-38 * 10^10.
  for (int i = 0; i < c.size(); ++i)
    for (int j = 0; j < count; ++j)
      EXPECT_LE(magnitude(Mpfr((after(i, j) - before(i, j)) / (2 * h) - P(i, j))), literal<Mpfr>("1e-28"))
          << i << " " << j;
}

TYPED_TEST(Legendre, XiIsHalfTheInverseRoot) {
  EXPECT_EQ(xi<TypeParam>(0), TypeParam(1) / 2);
  for (const int j : {1, 2, 10, 1'000}) {
    const TypeParam value = xi<TypeParam>(j), one = 1;
    EXPECT_LE(magnitude(TypeParam(value * value * 4 * (4 * j * j - 1) - one)), 8 * epsilon<TypeParam>());
    EXPECT_GT(value, 0);
  }
}

TYPED_TEST(Legendre, IntegralsAtTheNodesAreTheValuesTimesX) {
  for (const int s : {1, 2, 3, 7, 12}) {
    const auto gauss = gauss_legendre<TypeParam>(s);
    const Matrix<TypeParam> P = legendre_values<TypeParam>(gauss.c, s), X = X_matrix<TypeParam>(s),
                            integrals = legendre_integrals<TypeParam>(gauss.c, s);
    ASSERT_EQ(X.rows(), s);
    ASSERT_EQ(X.cols(), s);
    const Matrix<TypeParam> defect = integrals - P.lazyProduct(X);
    EXPECT_LE(max_norm(defect), this->tolerance()) << s;
  }
}

TYPED_TEST(Legendre, XIsSkewSymmetricButForItsFirstEntry) {
  const Matrix<TypeParam> X = X_matrix<TypeParam>(6);
  EXPECT_EQ(X(0, 0), TypeParam(1) / 2);
  for (int i = 1; i < 6; ++i) {
    EXPECT_EQ(X(i, i), 0);
    EXPECT_GT(X(i, i - 1), 0);
    for (int j = 0; j < i; ++j) {
      EXPECT_EQ(X(i, j), -X(j, i));
      EXPECT_EQ(X(i, j) != 0, j == i - 1);
    }
  }
}

}  // namespace
}  // namespace hbvm::core
