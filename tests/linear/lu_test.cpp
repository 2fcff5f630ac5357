#include "linear/lu.hpp"

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class LuTest : public InDigits<50> {
 protected:
  RandomValues<S> random{31};
  Lu<S> lu;

  bool factor(const Matrix<S>& a) {
    lu.set(a);
    return lu.factor();
  }

  /// What is left of a in a band; the diagonal is divided, so that rows are swapped.
  static Lu<S> cut_to_band(Matrix<S>& a, Index b, int divisor) {
    const Index n = a.rows();
    Lu<S> band;
    band.resize(n, b);
    band.set_zero();
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        if (std::abs(i - j) > b) a(i, j) = 0;
        if (i == j) a(i, j) = a(i, j) / divisor;
        if (std::abs(i - j) <= b) band.entry(i, j) = a(i, j);
      }
    return band;
  }

  /// a x = b is solved with a residual that partial pivoting allows for. That is n^2 eps |a| |x|, times the growth of
  /// the pivots, which is below 2^(n-1) and in practice below n.
  void expect_solves(const Matrix<S>& a) {
    const Index n = a.rows();
    ASSERT_TRUE(factor(a)) << "n = " << n;
    const Vector<S> b = random.vector(n);
    Vector<S> x = b;
    lu.solve(x);
    const Vector<S> residual = a.lazyProduct(x) - b;
    EXPECT_LE(max_norm(residual), S(n * n * n) * epsilon<S>() * max_norm(a) * max_norm(x)) << "n = " << n;
  }
};
TYPED_TEST_SUITE(LuTest, AllScalars, ScalarNames);

TYPED_TEST(LuTest, SolvesRandomSystems) {
  for (int n = 1; n <= 12; ++n)
    for (int trial = 0; trial < 10; ++trial) this->expect_solves(this->random.matrix(n, n));
}

/// Beyond 64 rows in double these are factored block by block.
TYPED_TEST(LuTest, SolvesLargeSystems) {
  for (const Index n : {63, 64, 65, 130}) this->expect_solves(this->random.matrix(n, n));
  Matrix<TypeParam> a = this->random.matrix(70, 70);
  EXPECT_FALSE(this->factor(Matrix<TypeParam>::Zero(70, 70)));
  a.col(40).setZero();
  EXPECT_FALSE(this->factor(a));
  a(3, 3) = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_FALSE(this->factor(a));
}

/// A band that is nearly as wide as the matrix is stored as a dense one; pivoting mixes its rows.
TYPED_TEST(LuTest, SolvesLargeSystemsWithWideBands) {
  for (const Index n : {64, 97, 131})
    for (const Index b : {n / 3 + 1, n / 2, n - 2}) {
      Matrix<TypeParam> a = this->random.matrix(n, n);
      Lu<TypeParam> banded = this->cut_to_band(a, b, 1024);
      ASSERT_TRUE(banded.factor());
      const Vector<TypeParam> x = this->random.matrix(n, 1).col(0);
      Vector<TypeParam> found = a * x;
      banded.solve(found);
      for (Index i = 0; i < n; ++i)
        EXPECT_LE(magnitude(TypeParam(found[i] - x[i])), TypeParam(1 << 24) * epsilon<TypeParam>()) << n << " " << b;
    }
}

TYPED_TEST(LuTest, SolvesWhatNeedsPivotingAtEveryStep) {
  for (int n = 2; n <= 12; ++n) {
    // The largest entries stand just below the diagonal, and the diagonal is 0.
    Matrix<TypeParam> a = this->random.matrix(n, n);
    for (int i = 0; i < n; ++i) {
      a(i, i) = 0;
      a(i, (i + n - 1) % n) = TypeParam(100 + i);
    }
    this->expect_solves(a);
  }
}

TYPED_TEST(LuTest, AppliesPermutationsInTheRightOrder) {
  for (int n = 1; n <= 7; ++n) {
    Matrix<TypeParam> a = Matrix<TypeParam>::Zero(n, n);
    // Powers of two, whose reciprocals are exact.
    for (int i = 0; i < n; ++i) a(i, (3 * i + 2) % n) = TypeParam(n % 3 == 0 ? 0 : 1 << i);
    if (n % 3 == 0)
      for (int i = 0; i < n; ++i) a(i, (i + 1) % n) = TypeParam(1 << i);
    ASSERT_TRUE(this->factor(a)) << n;
    Vector<TypeParam> expected(n);
    for (int i = 0; i < n; ++i) expected[i] = TypeParam(10 * i + 1);
    Vector<TypeParam> x = a.lazyProduct(expected);
    this->lu.solve(x);
    EXPECT_EQ(x, expected) << n;
  }
}

TYPED_TEST(LuTest, PivotingKeepsSmallPivotsHarmless) {
  Matrix<TypeParam> a(2, 2);
  a << epsilon<TypeParam>() * epsilon<TypeParam>(), TypeParam(1), TypeParam(1), TypeParam(1);
  ASSERT_TRUE(this->factor(a));
  Vector<TypeParam> x(2);
  x << TypeParam(1), TypeParam(2);
  this->lu.solve(x);
  EXPECT_LE(magnitude(TypeParam(x[0] - 1)), 4 * epsilon<TypeParam>());
  EXPECT_LE(magnitude(TypeParam(x[1] - 1)), 4 * epsilon<TypeParam>());
}

TYPED_TEST(LuTest, SolvesSeveralRightSidesWithOneFactorisation) {
  const Matrix<TypeParam> a = this->random.matrix(5, 5);
  ASSERT_TRUE(this->factor(a));
  for (int column = 0; column < 5; ++column) {
    Vector<TypeParam> x = Vector<TypeParam>::Unit(5, column);
    this->lu.solve(x);
    const Vector<TypeParam> residual = a.lazyProduct(x) - Vector<TypeParam>::Unit(5, column);
    EXPECT_LE(max_norm(residual), 125 * epsilon<TypeParam>() * max_norm(x));
  }
}

TYPED_TEST(LuTest, TakesMatricesOfAnotherSize) {
  for (const int n : {6, 2, 9, 1}) this->expect_solves(this->random.matrix(n, n));
}

/// A band is factored and solved to the last bit as the same matrix is without one.
TYPED_TEST(LuTest, TakesBands) {
  for (const Index n : {1, 2, 5, 9, 20}) {
    for (const Index b : {0, 1, 2, 3, 7}) {
      Matrix<TypeParam> a = this->random.matrix(n, n);
      Lu<TypeParam> band = this->cut_to_band(a, b, b > 0 ? 1000 : 1);
      ASSERT_TRUE(this->factor(a));
      ASSERT_TRUE(band.factor());
      Vector<TypeParam> x = this->random.vector(n), y = x;
      this->lu.solve(x);
      band.solve(y);
      EXPECT_EQ(x, y) << "n = " << n << ", b = " << b;
    }
  }
}

TYPED_TEST(LuTest, CostOfABandIsLinear) {
  Lu<TypeParam>& system = this->lu;
  const auto products = [&](Index n) {
    system.resize(n, 2);
    return system.factor_operations()[Op::multiply] + system.solve_operations()[Op::multiply];
  };
  EXPECT_EQ(products(1000) - products(999), 2u * 4u + 2u + 4u + 1u);
  EXPECT_EQ(products(500) - products(499), products(1000) - products(999));
}

TYPED_TEST(LuTest, CostOfAFullMatrix) {
  Lu<TypeParam>& system = this->lu;
  system.resize(4, 3);
  EXPECT_EQ(system.factor_operations()[Op::multiply], 9u + 4u + 1u);
  EXPECT_EQ(system.factor_operations()[Op::subtract], 9u + 4u + 1u);
  EXPECT_EQ(system.factor_operations()[Op::reciprocal], 3u + 2u + 1u + 4u);
  EXPECT_EQ(system.solve_operations()[Op::multiply], 12u + 4u);
}

TYPED_TEST(LuTest, RefusesSingularMatrices) {
  Matrix<TypeParam> dependent_rows(3, 3), zero_column(3, 3);
  dependent_rows << TypeParam(1), TypeParam(2), TypeParam(3), TypeParam(2), TypeParam(4), TypeParam(6), TypeParam(1),
      TypeParam(0), TypeParam(1);
  zero_column << TypeParam(1), TypeParam(0), TypeParam(3), TypeParam(2), TypeParam(0), TypeParam(6), TypeParam(1),
      TypeParam(0), TypeParam(5);
  EXPECT_FALSE(this->factor(dependent_rows));
  EXPECT_FALSE(this->factor(zero_column));
  EXPECT_FALSE(this->factor(Matrix<TypeParam>::Zero(1, 1)));
  EXPECT_FALSE(this->factor(Matrix<TypeParam>::Ones(4, 4)));
  this->expect_solves(this->random.matrix(3, 3));
}

TYPED_TEST(LuTest, RefusesWhatIsNotFinite) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam& bad : {Limits::infinity(), TypeParam(-Limits::infinity()), Limits::quiet_NaN()}) {
    for (int at = 0; at < 9; ++at) {
      Matrix<TypeParam> a = this->random.matrix(3, 3);
      a.data()[at] = bad;
      EXPECT_FALSE(this->factor(a)) << bad << " at " << at;
    }
  }
}

TYPED_TEST(LuTest, SolvesTheEmptySystem) {
  ASSERT_TRUE(this->factor(Matrix<TypeParam>(0, 0)));
  Vector<TypeParam> x(0);
  this->lu.solve(x);
  EXPECT_EQ(x.size(), 0);
}

}  // namespace
}  // namespace hbvm::core
