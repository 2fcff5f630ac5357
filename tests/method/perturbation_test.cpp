#include "method/perturbation.hpp"

#include <functional>
#include <set>
#include <vector>

#include "basis/legendre.hpp"
#include "hbvm/error.hpp"
#include "method/coefficients.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

using Part = Perturbation::Part;

Perturbation mistake(Part part, int i, int j, const char* relative, bool hat = false) {
  return {part, hat, i, j, Expression::parse(relative)};
}

template <class S>
class PerturbationTest : public InDigits<50> {
 protected:
  const Hbvm<S> method = make_hbvm<S>(5, 3), gauss = make_hbvm<S>(3, 3);

  static Hbvm<S> changed(Hbvm<S> method, const Perturbation& p) {
    perturb(method, p);
    return method;
  }

  /// Entries are sums of at most five products of numbers up to 5.
  const S tolerance = 64 * epsilon<S>();
  void expect_near(const S& value, const S& expected, const std::string& what) const {
    EXPECT_LE(magnitude(S(value - expected)), tolerance) << what;
  }
  void expect_near(const Matrix<S>& value, const Matrix<S>& expected, const std::string& what) const {
    ASSERT_EQ(value.rows(), expected.rows()) << what;
    ASSERT_EQ(value.cols(), expected.cols()) << what;
    EXPECT_LE(max_norm(Matrix<S>(value - expected)), tolerance) << what;
  }
  static void expect_differs(const Matrix<S>& a, const Matrix<S>& b, const std::string& what) {
    EXPECT_GE(max_norm(Matrix<S>(a - b)), literal<S>("1e-3")) << what;
  }

  /// What is not named is as it was: bit for bit, or to round-off if it is computed anew.
  void expect_only(const std::set<std::string>& named, const Hbvm<S>& m, const Hbvm<S>& before) const {
    const Coefficients<S> now = coefficients_of(m), then = coefficients_of(before);
    for (std::size_t n = 0; n < now.size(); ++n) {
      const auto& [name, value] = now[n];
      if (named.contains(name))
        expect_differs(value, then[n].second, name);
      else if (n < given_coefficients)
        EXPECT_EQ(value, then[n].second) << name;
      else
        expect_near(value, then[n].second, name);
    }
  }

  /// Where numbers meet: the projections are P^T diag(b), A = I_s times one, and l_i(1) = sum_j P_j(1) of it.
  void expect_consistent(const Hbvm<S>& m) const {
    const auto projection = [](const Matrix<S>& P, const Vector<S>& b) {
      return Matrix<S>(P.transpose().lazyProduct(Matrix<S>(b.asDiagonal())));
    };
    expect_near(m.projection, projection(m.P_s, m.b), "projection");
    expect_near(m.projection_hat, projection(m.P_hat, m.b_hat), "projection_hat");
    expect_near(m.A, m.I_s.lazyProduct(m.projection), "A");
    const Vector<S> end = Vector<S>::Constant(1, S(1));
    expect_near(m.lambda_at_1.transpose(), legendre_values<S>(end, m.s).lazyProduct(m.projection), "lambda_at_1");
  }

  static Matrix<S> without_row(Matrix<S> a, Index row) {
    a.row(row).setZero();
    return a;
  }
  static Matrix<S> without_column(Matrix<S> a, Index column) {
    a.col(column).setZero();
    return a;
  }
};
TYPED_TEST_SUITE(PerturbationTest, AllScalars, ScalarNames);

TYPED_TEST(PerturbationTest, NodeTakesItsRowsAlong) {
  using S = TypeParam;
  const auto m = this->changed(this->method, mistake(Part::node, 1, 0, "1/8"));
  this->expect_only({"c", "P_s", "I_s", "projection", "A", "lambda_at_1"}, m, this->method);
  this->expect_consistent(m);
  EXPECT_EQ(m.c[1], S(this->method.c[1] * 9 / 8));
  EXPECT_EQ(m.c[0], this->method.c[0]);
  EXPECT_EQ(m.c[2], this->method.c[2]);
  const Vector<S> node = Vector<S>::Constant(1, m.c[1]);
  this->expect_near(m.P_s.row(1), legendre_values<S>(node, 3), "P_s");
  this->expect_near(m.I_s.row(1), legendre_integrals<S>(node, 3), "I_s");
  EXPECT_EQ(this->without_row(m.P_s, 1), this->without_row(this->method.P_s, 1));
  EXPECT_EQ(this->without_row(m.I_s, 1), this->without_row(this->method.I_s, 1));
  this->expect_near(this->without_column(m.projection, 1), this->without_column(this->method.projection, 1),
                    "projection");
}

TYPED_TEST(PerturbationTest, NodeOfThePotentialLeavesTheConstraintsAlone) {
  using S = TypeParam;
  const auto m = this->changed(this->method, mistake(Part::node, 4, 0, "-1/8", true));
  this->expect_only({"c_hat", "P_hat", "I_hat", "projection_hat"}, m, this->method);
  this->expect_consistent(m);
  const Vector<S> node = Vector<S>::Constant(1, m.c_hat[4]);
  this->expect_near(m.P_hat.row(4), legendre_values<S>(node, 3), "P_hat");
  this->expect_near(m.I_hat.row(4), legendre_integrals<S>(node, 3), "I_hat");
}

TYPED_TEST(PerturbationTest, WeightChangesItsColumnOfTheProjection) {
  using S = TypeParam;
  const auto m = this->changed(this->method, mistake(Part::weight, 2, 0, "1/4"));
  this->expect_only({"b", "projection", "A", "lambda_at_1"}, m, this->method);
  this->expect_consistent(m);
  EXPECT_EQ(m.b[2], S(this->method.b[2] * 5 / 4));
  EXPECT_EQ(m.b[0], this->method.b[0]);
  EXPECT_EQ(m.b[1], this->method.b[1]);
  this->expect_near(m.projection.col(2), Matrix<S>(this->method.projection.col(2) * S(5) / S(4)), "projection");
  this->expect_near(this->without_column(m.A, 2), this->without_column(this->method.A, 2), "A");
}

TYPED_TEST(PerturbationTest, OtherNumbersOfThePotentialLeaveTheConstraintsAlone) {
  const auto weight = this->changed(this->method, mistake(Part::weight, 3, 0, "1/4", true)),
             integral = this->changed(this->method, mistake(Part::integral, 4, 2, "1", true));
  this->expect_only({"b_hat", "projection_hat"}, weight, this->method);
  this->expect_consistent(weight);
  this->expect_only({"I_hat"}, integral, this->method);
}

TYPED_TEST(PerturbationTest, IntegralChangesItsRowOfA) {
  using S = TypeParam;
  const auto m = this->changed(this->method, mistake(Part::integral, 2, 1, "1/2"));
  this->expect_only({"I_s", "A"}, m, this->method);
  this->expect_consistent(m);
  Matrix<S> expected = this->method.I_s;
  expected(2, 1) += expected(2, 1) / 2;
  this->expect_near(m.I_s, expected, "I_s");
  EXPECT_EQ(m.projection, this->method.projection) << "an integral is not in it";
  EXPECT_EQ(m.lambda_at_1, this->method.lambda_at_1) << "an integral is not in it";
  this->expect_near(this->without_row(m.A, 2), this->without_row(this->method.A, 2), "A");
}

TYPED_TEST(PerturbationTest, XIsAlone) {
  using S = TypeParam;
  for (const bool hat : {false, true}) {
    const auto m = this->changed(this->method, mistake(Part::X, 1, 0, "1/2", hat));
    Hbvm<S> expected = this->method;
    expected.X_s(1, 0) += expected.X_s(1, 0) / 2;
    this->expect_near(m.X_s, expected.X_s, "X_s");
    this->expect_only({"X_s"}, m, this->method);
    EXPECT_EQ(m.projection, this->method.projection);
    EXPECT_EQ(m.projection_hat, this->method.projection_hat);
    EXPECT_EQ(m.A, this->method.A);
    EXPECT_EQ(m.lambda_at_1, this->method.lambda_at_1);
  }
}

/// P_2 = sqrt(5) (6 c^2 - 6 c + 1), whose integral is sqrt(5) (2 c^3 - 3 c^2 + c).
TYPED_TEST(PerturbationTest, LegendreCoefficientChangesItsColumn) {
  using S = TypeParam;
  const char* const coefficients[] = {"sqrt(5)", "-6*sqrt(5)", "6*sqrt(5)"};
  for (int power = 0; power <= 2; ++power) {
    const auto m = this->changed(this->method, mistake(Part::legendre, 2, power, "1/16"));
    const S change = literal<S>(coefficients[power]) / 16;
    const auto expect_column = [&](const Vector<S>& c, const Matrix<S>& P, const Matrix<S>& I,
                                   const Matrix<S>& P_before, const Matrix<S>& I_before) {
      for (Index i = 0; i < c.size(); ++i) {
        S term = change;
        for (int n = 0; n < power; ++n) term *= c[i];
        this->expect_near(P(i, 2), S(P_before(i, 2) + term), "P c^" + std::to_string(power));
        this->expect_near(I(i, 2), S(I_before(i, 2) + term * c[i] / (power + 1)), "I c^" + std::to_string(power));
      }
      EXPECT_EQ(this->without_column(P, 2), this->without_column(P_before, 2));
      EXPECT_EQ(this->without_column(I, 2), this->without_column(I_before, 2));
    };
    expect_column(m.c, m.P_s, m.I_s, this->method.P_s, this->method.I_s);
    expect_column(m.c_hat, m.P_hat, m.I_hat, this->method.P_hat, this->method.I_hat);
    this->expect_only({"P_s", "I_s", "P_hat", "I_hat", "projection", "projection_hat", "A", "lambda_at_1"}, m,
                      this->method);
    // The polynomial is another one at 1 too.
    const Matrix<S> P_at_1 = legendre_values<S>(Vector<S>::Constant(1, S(1)), 3);
    Matrix<S> expected = P_at_1;
    expected(0, 2) += change;
    this->expect_near(m.lambda_at_1.transpose(), expected.lazyProduct(m.projection), "lambda_at_1");
    this->expect_near(m.A, m.I_s.lazyProduct(m.projection), "A");
  }
}

/// With every coefficient changed alike, the polynomial is.
TYPED_TEST(PerturbationTest, LegendreCoefficientsAreThoseOfThePolynomial) {
  using S = TypeParam;
  for (int degree = 0; degree <= 5; ++degree) {
    Hbvm<S> m = make_hbvm<S>(6, 6);
    const Hbvm<S> before = m;
    for (int power = 0; power <= degree; ++power) perturb(m, mistake(Part::legendre, degree, power, "1"));
    // The coefficients of P_5 reach 630 sqrt(11), and cancel.
    const S allowed = 8'000 * epsilon<S>();
    EXPECT_LE(max_norm(Vector<S>(m.P_s.col(degree) - 2 * before.P_s.col(degree))), allowed) << degree;
    EXPECT_LE(max_norm(Vector<S>(m.I_s.col(degree) - 2 * before.I_s.col(degree))), allowed) << degree;
  }
}

TYPED_TEST(PerturbationTest, MinusTwoFlipsTheSign) {
  using S = TypeParam;
  EXPECT_EQ(this->changed(this->method, mistake(Part::weight, 1, 0, "-2")).b[1], S(-this->method.b[1]));
  EXPECT_EQ(this->changed(this->method, mistake(Part::node, 1, 0, "-2")).c[1], S(-this->method.c[1]));
  EXPECT_EQ(this->changed(this->method, mistake(Part::X, 2, 1, "-2")).X_s(2, 1), S(-this->method.X_s(2, 1)));
  EXPECT_EQ(this->changed(this->method, mistake(Part::integral, 0, 2, "-2")).I_s(0, 2), S(-this->method.I_s(0, 2)));
}

TYPED_TEST(PerturbationTest, RefusesNumbersThatAreNotThere) {
  const auto refused = [&](const Perturbation& p) {
    auto m = this->method;
    EXPECT_THROW(perturb(m, p), InputError) << static_cast<int>(p.part) << " " << p.hat << " " << p.i << " " << p.j;
  };
  for (const Part part : {Part::node, Part::weight, Part::integral, Part::X, Part::legendre}) {
    refused(mistake(part, -1, 0, "1"));
    refused(mistake(part, 0, -1, "1"));
    refused(mistake(part, 3, 0, "1"));
  }
  for (const Part part : {Part::node, Part::weight, Part::integral}) {
    EXPECT_NO_THROW(this->changed(this->method, mistake(part, 4, 0, "1", true))) << "the potential has five nodes";
    refused(mistake(part, 5, 0, "1", true));
  }
  refused(mistake(Part::integral, 0, 3, "1"));
  refused(mistake(Part::integral, 0, 3, "1", true));
  refused(mistake(Part::X, 0, 3, "1"));
  refused(mistake(Part::legendre, 1, 2, "1"));
}

TYPED_TEST(PerturbationTest, RefusesNumbersThatAreZero) {
  auto m = this->method;
  EXPECT_THROW(perturb(m, mistake(Part::X, 0, 2, "1")), InputError) << "X_s is tridiagonal";
  EXPECT_THROW(perturb(m, mistake(Part::X, 1, 1, "1")), InputError) << "and 0 on the diagonal but for one";
  EXPECT_THROW(perturb(m, mistake(Part::weight, 0, 0, "1/0")), InputError);
}

/// Below the last digit of the precision there is nothing to notice.
TYPED_TEST(PerturbationTest, TwentyFifthDigitIsOfMpfrAlone) {
  using S = TypeParam;
  const Hbvm<S>& before = this->method;
  for (const auto& [part, i, j, hat] : {std::tuple(Part::weight, 1, 0, false),
                                        {Part::node, 0, 0, false},
                                        {Part::integral, 1, 1, false},
                                        {Part::X, 1, 0, false},
                                        {Part::legendre, 2, 2, false},
                                        {Part::node, 0, 0, true}}) {
    const Coefficients<S> now = coefficients_of(this->changed(before, mistake(part, i, j, "1e-25", hat))),
                          then = coefficients_of(before);
    const bool same = std::equal(now.begin(), now.end(), then.begin(),
                                 [](const auto& a, const auto& b) { return a.second == b.second; });
    EXPECT_EQ(same, (std::same_as<S, double>)) << static_cast<int>(part) << hat;
  }
}

/// More nodes for the constraints than stages: A = P X P^T Omega, and lambda has coefficients. No node and no weight
/// enters their sum at 1.
template <class S>
class PerturbationOfCoefficients : public PerturbationTest<S> {
 protected:
  const Hbvm<S> general = make_hbvm<S>(5, 3, 7);

  void expect_follows(const Hbvm<S>& m) const {
    const Matrix<S> weights = m.b.asDiagonal(), projection = m.P_s.transpose().lazyProduct(weights);
    this->expect_near(m.projection, projection, "projection");
    const Matrix<S> right = m.X_s.lazyProduct(projection);
    this->expect_near(m.A, m.P_s.lazyProduct(right), "A");
  }
};
TYPED_TEST_SUITE(PerturbationOfCoefficients, AllScalars, ScalarNames);

TYPED_TEST(PerturbationOfCoefficients, NodesAndWeightsOfTheConstraintsLeaveTheRestAlone) {
  using S = TypeParam;
  const auto node = this->changed(this->general, mistake(Part::node, 5, 0, "-1/8"));
  this->expect_only({"c", "P_s", "I_s", "projection", "A"}, node, this->general);
  this->expect_follows(node);
  EXPECT_EQ(node.c[5], S(this->general.c[5] * 7 / 8));
  const Vector<S> at = Vector<S>::Constant(1, node.c[5]);
  this->expect_near(node.P_s.row(5), legendre_values<S>(at, 3), "P_s");
  this->expect_near(node.I_s.row(5), legendre_integrals<S>(at, 3), "I_s");
  EXPECT_EQ(this->without_row(node.P_s, 5), this->without_row(this->general.P_s, 5));

  const auto weight = this->changed(this->general, mistake(Part::weight, 6, 0, "1"));
  this->expect_only({"b", "projection", "A"}, weight, this->general);
  this->expect_follows(weight);
  EXPECT_EQ(weight.b[6], S(2 * this->general.b[6]));
  this->expect_near(this->without_column(weight.projection, 6), this->without_column(this->general.projection, 6),
                    "projection");

  const auto integral = this->changed(this->general, mistake(Part::integral, 6, 2, "1"));
  this->expect_only({"I_s"}, integral, this->general);
  for (const auto& m : {node, weight, integral}) EXPECT_EQ(m.lambda_at_1, this->general.lambda_at_1);
}

TYPED_TEST(PerturbationOfCoefficients, XIsThatOfA) {
  using S = TypeParam;
  const auto m = this->changed(this->general, mistake(Part::X, 1, 0, "1/2"));
  this->expect_only({"X_s", "A"}, m, this->general);
  this->expect_follows(m);
  EXPECT_EQ(m.X_s(1, 0), S(this->general.X_s(1, 0) * 3 / 2));
  EXPECT_EQ(m.lambda_at_1, this->general.lambda_at_1);
}

TYPED_TEST(PerturbationOfCoefficients, ThoseOfThePotentialLeaveTheConstraintsAlone) {
  for (const auto& [part, named] :
       {std::pair(Part::node, std::set<std::string>{"c_hat", "P_hat", "I_hat", "projection_hat"}),
        {Part::weight, {"b_hat", "projection_hat"}},
        {Part::integral, {"I_hat"}}}) {
    const auto m = this->changed(this->general, mistake(part, 4, 1, "1/2", true));
    this->expect_only(named, m, this->general);
    this->expect_follows(m);
  }
}

TYPED_TEST(PerturbationOfCoefficients, LegendreCoefficientIsThatOfLambdaToo) {
  using S = TypeParam;
  const auto m = this->changed(this->general, mistake(Part::legendre, 2, 1, "1/16"));
  this->expect_only({"P_s", "I_s", "P_hat", "I_hat", "projection", "projection_hat", "A", "lambda_at_1"}, m,
                    this->general);
  this->expect_follows(m);
  // P_2 = sqrt(5) (6 c^2 - 6 c + 1)
  Vector<S> expected = this->general.lambda_at_1;
  expected[2] -= literal<S>("6*sqrt(5)/16");
  this->expect_near(Matrix<S>(m.lambda_at_1), Matrix<S>(expected), "lambda_at_1");
}

TYPED_TEST(PerturbationOfCoefficients, AsManyNodesForBothAreOneSet) {
  using S = TypeParam;
  for (const Hbvm<S>& equal : {this->gauss, make_hbvm<S>(7, 3, 7)})
    for (const bool hat : {false, true})
      for (const Part part : {Part::node, Part::weight, Part::integral, Part::legendre}) {
        const auto m = this->changed(equal, mistake(part, 2, 1, "1/8", hat));
        EXPECT_EQ(m.c_hat, m.c);
        EXPECT_EQ(m.b_hat, m.b);
        EXPECT_EQ(m.P_hat, m.P_s);
        EXPECT_EQ(m.I_hat, m.I_s);
        this->expect_near(m.projection_hat, m.projection, "projection_hat");
        // What is compared is what changed.
        if (equal.r == equal.s) {
          this->expect_differs(m.A, equal.A, "A");
        } else {
          this->expect_follows(m);
          this->expect_differs(part == Part::weight ? m.projection : m.I_s,
                               part == Part::weight ? equal.projection : equal.I_s, "the number");
        }
      }
}

TYPED_TEST(PerturbationOfCoefficients, ThereAreAsManyNumbersAsNodes) {
  for (const Part part : {Part::node, Part::weight, Part::integral}) {
    EXPECT_NO_THROW(this->changed(this->general, mistake(part, 6, 0, "1")));
    EXPECT_THROW(this->changed(this->general, mistake(part, 7, 0, "1")), InputError);
    EXPECT_THROW(this->changed(this->general, mistake(part, 5, 0, "1", true)), InputError) << "the potential has five";
  }
  EXPECT_THROW(this->changed(this->general, mistake(Part::integral, 0, 3, "1")), InputError);
  EXPECT_THROW(this->changed(this->general, mistake(Part::X, 3, 2, "1")), InputError);
}

TEST(PerturbationPrecision, RelativeChangeIsExactToTheDigitsOfTheScope) {
  const PrecisionScope digits(50);
  Hbvm<Mpfr> m = make_hbvm<Mpfr>(2, 2);
  const Mpfr before = m.b[0];
  perturb(m, mistake(Part::weight, 0, 0, "1e-25"));
  EXPECT_LE(magnitude(Mpfr(m.b[0] / before - 1 - literal<Mpfr>("1e-25"))), 4 * epsilon<Mpfr>());
  for (const Mpfr& x : {m.b[0], m.A(0, 0), m.lambda_at_1[0], m.projection(1, 0)})
    EXPECT_EQ(mpfr_get_prec(raw(x)), mpfr_working_bits());
}

}  // namespace
}  // namespace hbvm::core
