#include "solver/continuation.hpp"

#include "basis/legendre.hpp"
#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ContinuationTest : public InDigits<50> {
 protected:
  static constexpr int s = 7;
  RandomValues<S> random{11};
  Hbvm<S> method = make_hbvm<S>(s, s);

  StageUnknowns<S> polynomials(Index m, Index nu, int decay_bits) {
    const Matrix<S> zero = Matrix<S>::Zero(s, m);
    StageUnknowns<S> x{zero, zero, zero, Matrix<S>::Zero(s, nu)};
    S size = 1;
    for (Index i = 0; i < s; ++i, size *= power_of_two<S>(-decay_bits))
      for (Index j = 0; j < m; ++j) x.gamma(i, j) = size * (1 + magnitude(random.value()));
    for (Index j = 0; j < x.lambda.size(); ++j) x.lambda.data()[j] = random.value();
    return x;
  }
};
TYPED_TEST_SUITE(ContinuationTest, AllScalars, ScalarNames);

/// The coefficients found take the values of the old polynomial one step on; multipliers at the nodes, by Lagrange's
/// formula, those of theirs.
TYPED_TEST(ContinuationTest, FollowsPolynomialsBeyondTheStep) {
  using S = TypeParam;
  const StageUnknowns<S> last = this->polynomials(2, 3, 0);
  Continuation<S> continuation(this->method, {0, 0}, 3);
  continuation.keep(last);
  StageUnknowns<S> x = last;
  continuation.predict(x);
  const Vector<S>& c = this->method.c;
  const Vector<S> later = c.array() + S(1);
  const Matrix<S> now = legendre_values<S>(c, this->s), beyond = legendre_values<S>(later, this->s);
  const S tolerance = S(1000) * max_norm(beyond) * epsilon<S>();
  const Matrix<S> found = now.lazyProduct(x.gamma), true_values = beyond.lazyProduct(last.gamma);
  for (Index i = 0; i < found.size(); ++i)
    EXPECT_LE(magnitude(S(found.data()[i] - true_values.data()[i])), tolerance) << i;
  for (Index a = 0; a < 3; ++a)
    for (Index i = 0; i < this->s; ++i) {
      S sum = 0;
      for (Index l = 0; l < this->s; ++l) {
        S lagrange = last.lambda(l, a);
        for (Index n = 0; n < this->s; ++n)
          if (n != l) lagrange *= (later[i] - c[n]) / (c[l] - c[n]);
        sum += lagrange;
      }
      EXPECT_LE(magnitude(S(sum - x.lambda(i, a))), 100 * tolerance) << a << " " << i;
    }
}

/// With more nodes for the constraints than stages the multipliers have coefficients, as the momenta have.
TYPED_TEST(ContinuationTest, FollowsCoefficientsOfMultipliers) {
  using S = TypeParam;
  const Hbvm<S> general = make_hbvm<S>(this->s, this->s, this->s + 2);
  const StageUnknowns<S> last = this->polynomials(2, 3, 0);
  Continuation<S> continuation(general, {0, 0}, 3), at_nodes(this->method, {0, 0}, 3);
  continuation.keep(last);
  StageUnknowns<S> x = last;
  continuation.predict(x);
  const Vector<S>&c = general.c, later = c.array() + S(1);
  const Matrix<S> now = legendre_values<S>(c, this->s), beyond = legendre_values<S>(later, this->s);
  const S tolerance = S(1000) * max_norm(beyond) * epsilon<S>();
  for (const auto& [found, before] : {std::pair(&x.lambda, &last.lambda), {&x.gamma, &last.gamma}}) {
    const Matrix<S> values = now.lazyProduct(*found), expected = beyond.lazyProduct(*before);
    EXPECT_LE(max_norm(Matrix<S>(values - expected)), tolerance);
  }
  // The same polynomials by their values.
  StageUnknowns<S> nodal = last;
  nodal.lambda = this->method.P_s.lazyProduct(last.lambda);
  at_nodes.keep(nodal);
  at_nodes.predict(nodal);
  const Matrix<S> same = this->method.P_s.lazyProduct(x.lambda);
  EXPECT_LE(max_norm(Matrix<S>(nodal.lambda - same)), 100 * tolerance);
  EXPECT_EQ(nodal.gamma, x.gamma);
}

/// Of momenta that are a polynomial of degree 2 but for rounding, multipliers of higher degree are left out, too.
TYPED_TEST(ContinuationTest, LeavesOutWhatIsRoundingOfCoefficientsToo) {
  using S = TypeParam;
  const Hbvm<S> general = make_hbvm<S>(this->s, this->s, this->s + 2);
  StageUnknowns<S> last = this->polynomials(2, 1, 0);
  for (Index i = 3; i < this->s; ++i) last.gamma.row(i) *= epsilon<S>();
  Continuation<S> continuation(general, {0, 0}, 1);
  continuation.keep(last);
  StageUnknowns<S> x = last;
  continuation.predict(x);
  EXPECT_EQ(max_norm(Matrix<S>(x.gamma.bottomRows(this->s - 3))), 0);
  EXPECT_EQ(max_norm(Matrix<S>(x.lambda.bottomRows(this->s - 3))), 0);
  EXPECT_GT(max_norm(x.lambda), 0);
}

/// Seven terms grow by 2^13; coefficients that fall by 2^-10 each leave 2^-50 of the last but one.
TYPED_TEST(ContinuationTest, KnowsWhatTheGrowthLeaves) {
  using S = TypeParam;
  Continuation<S> continuation(this->method, {0, 1, 2}, 0);
  EXPECT_GT(continuation.error_exponent(0), 1000);
  StageUnknowns<S> last = this->polynomials(3, 0, 10);
  last.gamma(this->s - 1, 1) = last.gamma(0, 1);
  last.gamma.col(2).setZero();
  continuation.keep(last);
  EXPECT_NEAR(static_cast<double>(continuation.error_exponent(0) - continuation.size_exponent(0)), 13 - 50, 2);
  EXPECT_GT(continuation.error_exponent(1), continuation.size_exponent(1));
  EXPECT_EQ(continuation.error_exponent(2), exponent_of_zero);
  continuation.clear();
  EXPECT_GT(continuation.error_exponent(0), 1000);
}

}  // namespace
}  // namespace hbvm::core
