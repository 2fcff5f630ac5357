#include "method/hbvm.hpp"

#include <cmath>
#include <tuple>
#include <vector>

#include "basis/gauss_legendre.hpp"
#include "hbvm/error.hpp"
#include "method/coefficients.hpp"
#include "method/order_conditions.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

struct Stages {
  int k, s;
};
constexpr Stages choices[] = {{1, 1}, {4, 1}, {2, 2}, {3, 2}, {5, 3}, {12, 6}, {6, 6}, {30, 10}, {40, 20}};

template <class S>
class HbvmCoefficients : public InDigits<50> {
 protected:
  RandomValues<S> random{17};

  /// Each entry of an identity of size n is a sum of n products of numbers rounded once, none above 2 n.
  S tolerance(int n) const { return S(8 * n * n) * epsilon<S>(); }
};
TYPED_TEST_SUITE(HbvmCoefficients, AllScalars, ScalarNames);

template <Scalar S>
Matrix<S> times(const Matrix<S>& a, const Matrix<S>& b) {
  return a.lazyProduct(b);
}
template <Scalar S>
Matrix<S> defect_from_identity(const Matrix<S>& a) {
  return a - Matrix<S>::Identity(a.rows(), a.cols());
}

/// |value - reference| in ulps of the value. What is 0 in the reference's digits may be anything below `nothing`.
template <Scalar S>
double ulps_apart(const S& value, mpfr_srcptr reference, mpfr_srcptr nothing) {
  const BigFloat exact = exactly(value);
  if (mpfr_cmpabs(reference, nothing) < 0 && mpfr_cmpabs(raw(exact), nothing) < 0) return 0;
  BigFloat difference(mpfr_get_prec(reference));
  mpfr_sub(raw(difference), raw(exact), reference, MPFR_RNDN);
  const long ulp = mpfr_regular_p(raw(exact)) ? mpfr_get_exp(raw(exact)) - mpfr_get_prec(raw(exact)) : 0;
  mpfr_mul_2si(raw(difference), raw(difference), -ulp, MPFR_RNDN);
  return std::abs(mpfr_get_d(raw(difference), MPFR_RNDN));
}

TYPED_TEST(HbvmCoefficients, AgreeWithFortyMoreDigits) {
  for (const Stages& choice : choices) {
    const Coefficients<TypeParam> coefficients = coefficients_of(make_hbvm<TypeParam>(choice.k, choice.s));
    const auto working = static_cast<unsigned>(digits10<TypeParam>());
    const PrecisionScope scope(working + 40);
    const Coefficients<Mpfr> references = coefficients_of(make_hbvm<Mpfr>(choice.k, choice.s));
    const Mpfr nothing = pow(Mpfr(10), -static_cast<int>(working) - 10);
    for (std::size_t n = 0; n < coefficients.size(); ++n) {
      const auto& [name, values] = coefficients[n];
      const Matrix<Mpfr>& reference = references[n].second;
      ASSERT_EQ(values.rows(), reference.rows()) << name;
      ASSERT_EQ(values.cols(), reference.cols()) << name;
      double worst = 0;
      for (Index i = 0; i < values.size(); ++i)
        worst = std::max(worst, ulps_apart(values.data()[i], raw(reference.data()[i]), raw(nothing)));
      EXPECT_LE(worst, 1.0) << name << " of k = " << choice.k << ", s = " << choice.s;
    }
  }
}

TYPED_TEST(HbvmCoefficients, HaveTheirShapes) {
  const auto m = make_hbvm<TypeParam>(5, 3);
  EXPECT_EQ(m.k, 5);
  EXPECT_EQ(m.s, 3);
  // c, b, c_hat, b_hat, P_s, I_s, P_hat, I_hat, X_s, projection, projection_hat, A, lambda_at_1
  const std::pair<Index, Index> expected[] = {{3, 1}, {3, 1}, {5, 1}, {5, 1}, {3, 3}, {3, 3}, {5, 3},
                                              {5, 3}, {3, 3}, {3, 3}, {3, 5}, {3, 3}, {3, 1}};
  const Coefficients<TypeParam> all = coefficients_of(m);
  ASSERT_EQ(all.size(), std::size(expected));
  for (std::size_t n = 0; n < all.size(); ++n)
    EXPECT_EQ(std::pair(all[n].second.rows(), all[n].second.cols()), expected[n]) << all[n].first;
}

TYPED_TEST(HbvmCoefficients, NodesAreGauss) {
  const auto m = make_hbvm<TypeParam>(7, 4);
  const auto gauss = gauss_legendre<TypeParam>(4), gauss_hat = gauss_legendre<TypeParam>(7);
  EXPECT_EQ(m.c, gauss.c);
  EXPECT_EQ(m.b, gauss.b);
  EXPECT_EQ(m.c_hat, gauss_hat.c);
  EXPECT_EQ(m.b_hat, gauss_hat.b);
}

TYPED_TEST(HbvmCoefficients, HatsAreTheMethodItselfForKEqualToS) {
  const auto m = make_hbvm<TypeParam>(4, 4);
  EXPECT_EQ(m.P_hat, m.P_s);
  EXPECT_EQ(m.I_hat, m.I_s);
  EXPECT_EQ(m.projection_hat, m.projection);
}

TYPED_TEST(HbvmCoefficients, IntegralsAreValuesTimesX) {
  for (const auto& [k, s] : choices) {
    const auto m = make_hbvm<TypeParam>(k, s);
    EXPECT_LE(max_norm(Matrix<TypeParam>(m.I_s - times(m.P_s, m.X_s))), this->tolerance(s)) << s;
  }
}

TYPED_TEST(HbvmCoefficients, ProjectionInvertsTheValues) {
  for (const auto& [k, s] : choices) {
    const auto m = make_hbvm<TypeParam>(k, s);
    EXPECT_LE(max_norm(defect_from_identity(times(m.projection, m.P_s))), this->tolerance(s)) << s;
    EXPECT_LE(max_norm(defect_from_identity(times(m.P_s, m.projection))), this->tolerance(s)) << s;
    EXPECT_LE(max_norm(defect_from_identity(times(m.projection_hat, m.P_hat))), this->tolerance(k)) << k << " " << s;
  }
}

TYPED_TEST(HbvmCoefficients, ButcherMatrixIsPXProjection) {
  for (const auto& [k, s] : choices) {
    const auto m = make_hbvm<TypeParam>(k, s);
    EXPECT_LE(max_norm(Matrix<TypeParam>(m.A - times(times(m.P_s, m.X_s), m.projection))), this->tolerance(s)) << s;
  }
}

TYPED_TEST(HbvmCoefficients, OneStageIsTheMidpointRule) {
  const auto m = make_hbvm<TypeParam>(1, 1);
  const TypeParam half = TypeParam(1) / 2;
  EXPECT_EQ(m.c[0], half);
  EXPECT_EQ(m.b[0], 1);
  EXPECT_EQ(m.A(0, 0), half);
  EXPECT_EQ(m.P_s(0, 0), 1);
  EXPECT_EQ(m.I_s(0, 0), half);
  EXPECT_EQ(m.X_s(0, 0), half);
  EXPECT_EQ(m.projection(0, 0), 1);
  EXPECT_EQ(m.lambda_at_1[0], 1);
}

TYPED_TEST(HbvmCoefficients, TwoStagesHaveTheirClosedForm) {
  const auto m = make_hbvm<TypeParam>(2, 2);
  const auto expect_near = [](const TypeParam& value, const char* exact) {
    const TypeParam expected = literal<TypeParam>(exact);
    EXPECT_LE(magnitude(TypeParam(value - expected)), epsilon<TypeParam>() * magnitude(expected)) << exact;
  };
  expect_near(m.c[0], "1/2-sqrt(3)/6");
  expect_near(m.c[1], "1/2+sqrt(3)/6");
  expect_near(m.A(0, 0), "1/4");
  expect_near(m.A(0, 1), "1/4-sqrt(3)/6");
  expect_near(m.A(1, 0), "1/4+sqrt(3)/6");
  expect_near(m.A(1, 1), "1/4");
  expect_near(m.lambda_at_1[0], "(1-sqrt(3))/2");
  expect_near(m.lambda_at_1[1], "(1+sqrt(3))/2");
  expect_near(m.X_s(1, 0), "1/(2*sqrt(3))");
  expect_near(m.X_s(0, 1), "-1/(2*sqrt(3))");
  expect_near(m.P_s(0, 1), "-1");
  expect_near(m.projection(1, 1), "1/2");
}

/// The Butcher matrix I_hat projection_hat of the k-stage method integrates polynomials of degree < s exactly, too.
TYPED_TEST(HbvmCoefficients, SatisfyConditionsBAndC) {
  using S = TypeParam;
  for (const auto& [k, s] : choices) {
    const auto m = make_hbvm<S>(k, s);
    const RungeKutta<S> method{m.A, m.b, m.c}, hats{times(m.I_hat, m.projection_hat), m.b_hat, m.c_hat};
    EXPECT_LE(condition_B(method, 2 * s), this->tolerance(s)) << s;
    EXPECT_LE(condition_C(method, s), this->tolerance(s)) << s;
    EXPECT_LE(condition_C(hats, s), this->tolerance(k)) << k << " " << s;
  }
}

TYPED_TEST(HbvmCoefficients, LagrangeExtrapolatesPolynomialsToOne) {
  using std::pow;
  for (const auto& [k, s] : choices) {
    const auto m = make_hbvm<TypeParam>(k, s);
    for (int degree = 0; degree < s; ++degree) {
      TypeParam sum = 0;
      for (int i = 0; i < s; ++i) sum += m.lambda_at_1[i] * pow(m.c[i], degree);
      EXPECT_LE(magnitude(TypeParam(sum - 1)), this->tolerance(s)) << "c^" << degree << ", s = " << s;
    }
  }
}

TYPED_TEST(HbvmCoefficients, RefusesStagesOutOfRange) {
  for (const auto& [k, s] : {Stages{0, 0}, Stages{0, 1}, Stages{1, 0}, Stages{2, 3}, Stages{-1, -1},
                             Stages{max_k + 1, 1}, Stages{max_s + 1, max_s + 1}})
    EXPECT_THROW(make_hbvm<TypeParam>(k, s), InputError) << k << " " << s;
}

TEST(HbvmInDouble, LargestNumberOfStagesIsFinite) {
  const Hbvm<double> m = make_hbvm<double>(max_s, max_s);
  for (const auto& [name, values] : coefficients_of(m)) EXPECT_TRUE(std::isfinite(max_norm(values))) << name;
  EXPECT_LE(max_norm(defect_from_identity(times(m.projection, m.P_s))), 8 * max_s * epsilon<double>());
}

TEST(HbvmInMpfr, CoefficientsHaveTheDigitsOfTheScope) {
  const PrecisionScope scope(37);
  for (const auto& [name, values] : coefficients_of(make_hbvm<Mpfr>(5, 3)))
    for (Index i = 0; i < values.size(); ++i)
      EXPECT_EQ(mpfr_get_prec(raw(values.data()[i])), mpfr_working_bits()) << name;
  EXPECT_EQ(Mpfr::thread_default_precision(), 37u);
}

/// With more nodes for the constraints than stages the multipliers have coefficients.
TYPED_TEST(HbvmCoefficients, OfMoreNodesForTheConstraints) {
  using S = TypeParam;
  for (const auto& [k, s, r] : {std::tuple(1, 1, 2), {3, 2, 3}, {3, 3, 9}, {9, 6, 9}, {20, 10, 40}}) {
    const Hbvm<S> m = make_hbvm<S>(k, s, r), few = make_hbvm<S>(k, s);
    const S tolerance = this->tolerance(r);
    ASSERT_EQ(m.r, r);
    EXPECT_TRUE(m.has_coefficients_of_lambda());
    EXPECT_FALSE(few.has_coefficients_of_lambda());
    EXPECT_EQ(m.P_s.rows(), r);
    EXPECT_EQ(m.projection.cols(), r);
    EXPECT_LE(max_norm(defect_from_identity(times(m.projection, m.P_s))), tolerance);
    EXPECT_LE(max_norm(Matrix<S>(times(m.projection, m.I_s) - m.X_s)), tolerance) << "but for the part of P_s";
    EXPECT_LE(max_norm(Matrix<S>(m.A - times(m.P_s, times(m.X_s, m.projection)))), tolerance);
    for (int l = 0; l < s; ++l) {
      using std::sqrt;
      EXPECT_LE(magnitude(S(m.lambda_at_1[l] - sqrt(S(2 * l + 1)))), tolerance);
    }
    // The rest does not know of them.
    EXPECT_EQ(m.X_s, few.X_s);
    EXPECT_EQ(m.P_hat, few.P_hat);
    EXPECT_EQ(m.I_hat, few.I_hat);
    EXPECT_EQ(m.projection_hat, few.projection_hat);
    const Hbvm<double> rounded = in_double(m);
    EXPECT_EQ(rounded.r, r);
    EXPECT_EQ(rounded.A.rows(), r);
  }
  EXPECT_THROW(make_hbvm<S>(3, 3, 2), InputError);
  EXPECT_THROW(make_hbvm<S>(3, 3, max_k + 1), InputError);
}

TYPED_TEST(HbvmCoefficients, WithAsManyAsStagesAreThePapers) {
  using S = TypeParam;
  const auto with = coefficients_of(make_hbvm<S>(5, 3, 3)), without = coefficients_of(make_hbvm<S>(5, 3));
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_EQ(with[i].second, without[i].second) << with[i].first;
}

}  // namespace
}  // namespace hbvm::core
