#include "basis/gauss_legendre.hpp"

#include <string>
#include <tuple>
#include <vector>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scalar/arb.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

/// What the guard digits leave of an ulp beside the one rounding: a trifle, as log2.
constexpr slong trifle = -16;

/// Certainly |value - truth| <= quarters/4 ulps of `value` and a trifle, however wide the enclosure of the truth.
template <Scalar S>
bool within_ulps(const S& value, const RealBall& truth, int quarters) {
  const BigFloat exact = exactly(value);
  const slong precision = 2 * mpfr_get_prec(raw(exact)) + 200;
  RealBall distance, bound;
  arf_set_mpfr(arb_midref(raw(distance)), raw(exact));
  arb_sub(raw(distance), raw(distance), raw(truth), precision);
  arb_abs(raw(distance), raw(distance));
  RealBall rest;
  arb_set_si(raw(bound), quarters);
  arb_mul_2exp_si(raw(bound), raw(bound), -2);
  arb_one(raw(rest));
  arb_mul_2exp_si(raw(rest), raw(rest), trifle);
  arb_add(raw(bound), raw(bound), raw(rest), precision);
  arb_mul_2exp_si(raw(bound), raw(bound), mpfr_get_exp(raw(exact)) - mpfr_get_prec(raw(exact)));
  return arb_le(raw(distance), raw(bound)) != 0;
}

template <Scalar S>
void expect_certified(int n) {
  const Quadrature<S> formula = gauss_legendre<S>(n);
  ASSERT_EQ(formula.c.size(), n);
  ASSERT_EQ(formula.b.size(), n);
  const slong precision = significand_bits<S>() + 100;
  // 1 - c is rounded again, and c was by half an ulp of a number half as large.
  constexpr int half = 2, three_quarters = 3;
  RealBall root, weight, c;
  for (int k = 0; 2 * k < n; ++k) {
    arb_hypgeom_legendre_p_ui_root(raw(root), raw(weight), static_cast<ulong>(n), static_cast<ulong>(k), precision);
    arb_mul_2exp_si(raw(weight), raw(weight), -1);
    arb_sub_ui(raw(c), raw(root), 1, precision);
    arb_neg(raw(c), raw(c));
    arb_mul_2exp_si(raw(c), raw(c), -1);
    EXPECT_TRUE(within_ulps(formula.c[k], c, half)) << "c_" << k << " = " << formula.c[k];
    EXPECT_TRUE(within_ulps(formula.b[k], weight, half)) << "b_" << k << " = " << formula.b[k];
    arb_add_ui(raw(c), raw(root), 1, precision);
    arb_mul_2exp_si(raw(c), raw(c), -1);
    EXPECT_TRUE(within_ulps(formula.c[n - 1 - k], c, 2 * k + 1 == n ? half : three_quarters))
        << "c_" << n - 1 - k << " = " << formula.c[n - 1 - k];
    EXPECT_TRUE(within_ulps(formula.b[n - 1 - k], weight, half)) << "b_" << n - 1 - k << " = " << formula.b[n - 1 - k];
  }
}

template <Scalar S>
void expect_symmetric(int n) {
  const Quadrature<S> formula = gauss_legendre<S>(n);
  const S one = 1;
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(formula.b[n - 1 - i], formula.b[i]);
    if (2 * i + 1 == n) {
      EXPECT_EQ(2 * formula.c[i], one);
    } else if (2 * i + 1 < n) {
      EXPECT_LT(2 * formula.c[i], one);
      EXPECT_EQ(formula.c[n - 1 - i], one - formula.c[i]);
    }
    if (i > 0) {
      EXPECT_LT(formula.c[i - 1], formula.c[i]);
    }
  }
  EXPECT_GT(formula.c[0], 0);
  EXPECT_LT(formula.c[n - 1], one);
}

/// B(2n): sum_i b_i c_i^(j-1) = 1/j for j = 1 ... 2n, summed with guard digits so that only the rounding of the nodes
/// and weights remains. Each c_i^(j-1) is off by (j - 1) eps, each b_i by eps.
template <Scalar S>
void expect_moments(int n) {
  const Quadrature<S> formula = gauss_legendre<S>(n);
  const BigFloat eps = exactly(epsilon<S>());
  const PrecisionScope guarded(static_cast<unsigned>(digits10<S>() + 40));
  const auto exact = [](const S& x) { return rounded_to<Mpfr>(raw(exactly(x))); };
  Vector<Mpfr> term(n), c(n);
  for (int i = 0; i < n; ++i) {
    term[i] = exact(formula.b[i]);
    c[i] = exact(formula.c[i]);
  }
  Mpfr worst = 0;
  for (int j = 1; j <= 2 * n; ++j) {
    Mpfr sum = 0;
    for (int i = 0; i < n; ++i) {
      sum += term[i];
      term[i] *= c[i];
    }
    raise_to(worst, magnitude(Mpfr(j * sum - 1)) / j);
  }
  EXPECT_LE(worst, rounded_to<Mpfr>(raw(eps)));
}

class GaussLegendre : public ::testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Precision precision = Precision::parse(std::get<0>(GetParam()));
  int n = std::get<1>(GetParam());
};

TEST_P(GaussLegendre, IsTheCertifiedRootsRoundedOnce) {
  with_scalar(precision, [&]<Scalar S>() { expect_certified<S>(n); });
}

TEST_P(GaussLegendre, IsSymmetricToTheLastBit) {
  with_scalar(precision, [&]<Scalar S>() { expect_symmetric<S>(n); });
}

TEST_P(GaussLegendre, IntegratesMonomials) {
  with_scalar(precision, [&]<Scalar S>() { expect_moments<S>(n); });
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<const char*, int>>& info) {
  std::string name = std::get<0>(info.param);
  for (char& c : name)
    if (c == ':') c = '_';
  return name + "_" + std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Nodes, GaussLegendre,
                         ::testing::Combine(::testing::Values("double", "quad", "mpfr:50", "mpfr:1000"),
                                            ::testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 33, 100,
                                                              1'000)),
                         name_of);

template <class S>
class GaussLegendreFormula : public InDigits<50> {};
TYPED_TEST_SUITE(GaussLegendreFormula, AllScalars, ScalarNames);

TYPED_TEST(GaussLegendreFormula, RefusesANumberOfNodesOutOfRange) {
  for (const int n : {0, -1, -1'000, max_quadrature_nodes + 1, 1'000'000'000})
    EXPECT_THROW(gauss_legendre<TypeParam>(n), InputError) << n;
}

/// None of these lies so near the middle of two numbers that the guard bits would not tell which is the nearer. All are
/// those of 30 more digits, rounded.
TYPED_TEST(GaussLegendreFormula, IsRoundedCorrectly) {
  using S = TypeParam;
  for (int n = 1; n <= 100; ++n) {
    const Quadrature<S> formula = gauss_legendre<S>(n);
    std::vector<BigFloat> c, b;
    {
      const PrecisionScope more(static_cast<unsigned>(digits10<S>() + 30));
      const Quadrature<Mpfr> fine = gauss_legendre<Mpfr>(n);
      for (int k = 0; 2 * k < n; ++k) {
        c.push_back(exactly(fine.c[k]));
        b.push_back(exactly(fine.b[k]));
      }
    }
    for (int k = 0; 2 * k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      ASSERT_EQ(formula.c[k], rounded_to<S>(raw(c[i]))) << "c_" << k << " of " << n;
      ASSERT_EQ(formula.b[k], rounded_to<S>(raw(b[i]))) << "b_" << k << " of " << n;
    }
  }
}

TYPED_TEST(GaussLegendreFormula, ManyNodesHaveTheRightSumsAndEnds) {
  const int n = 1'501;
  const Quadrature<TypeParam> formula = gauss_legendre<TypeParam>(n);
  TypeParam weights = 0, mean = 0;
  for (int i = 0; i < n; ++i) {
    weights += formula.b[i];
    mean += formula.b[i] * formula.c[i];
  }
  EXPECT_LE(magnitude(TypeParam(weights - 1)), n * epsilon<TypeParam>());
  EXPECT_LE(magnitude(TypeParam(2 * mean - 1)), 2 * n * epsilon<TypeParam>());
}

TEST(GaussLegendreOnRequest, UsesTheDigitsOfEachCall) {
  const auto third = [](unsigned digits) {
    const PrecisionScope scope(digits);
    return exactly(gauss_legendre<Mpfr>(7).c[2]);
  };
  const BigFloat coarse = third(30), fine = third(60), again = third(30);
  EXPECT_GT(mpfr_get_prec(raw(fine)), mpfr_get_prec(raw(coarse)));
  EXPECT_NE(mpfr_cmp(raw(fine), raw(coarse)), 0);
  EXPECT_EQ(mpfr_cmp(raw(again), raw(coarse)), 0);
  BigFloat rounded = coarse;
  mpfr_set(raw(rounded), raw(fine), MPFR_RNDN);
  EXPECT_EQ(mpfr_cmp(raw(rounded), raw(coarse)), 0);
}

}  // namespace
}  // namespace hbvm::core
