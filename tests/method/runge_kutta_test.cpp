#include "hbvm/method/runge_kutta.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "hbvm/error.hpp"
#include "hbvm/method/hbvm.hpp"
#include "hbvm/scalar/literal.hpp"
#include "printing.hpp"

namespace hbvm {
namespace {

using Texts = std::vector<std::string>;

std::vector<Expression> parsed(const Texts& texts) {
  std::vector<Expression> result;
  for (const std::string& text : texts) result.push_back(Expression::parse(text));
  return result;
}

Tableau tableau(const std::vector<Texts>& A, const Texts& b, const Texts& c) {
  Tableau r{"test", {}, parsed(b), parsed(c), {}};
  for (const Texts& row : A) r.A.push_back(parsed(row));
  return r;
}

Tableau rk4() {
  return tableau({{"0", "0", "0", "0"}, {"1/2", "0", "0", "0"}, {"0", "0.5", "0", "0"}, {"0", "0", "1", "0"}},
                 {"1/6", "1/3", "1/3", "1/6"}, {"0", "1/2", "1/2", "1"});
}
Tableau radau_iia() { return tableau({{"5/12", "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"}); }

/// Dormand and Prince, order 5: large coefficients of both signs.
Tableau dopri5() {
  return tableau({{"0", "0", "0", "0", "0", "0"},
                  {"1/5", "0", "0", "0", "0", "0"},
                  {"3/40", "9/40", "0", "0", "0", "0"},
                  {"44/45", "-56/15", "32/9", "0", "0", "0"},
                  {"19372/6561", "-25360/2187", "64448/6561", "-212/729", "0", "0"},
                  {"9017/3168", "-355/33", "46732/5247", "49/176", "-5103/18656", "0"}},
                 {"35/384", "0", "500/1113", "125/192", "-2187/6784", "11/84"},
                 {"0", "1/5", "3/10", "4/5", "8/9", "1"});
}

template <Scalar S>
RungeKutta<S> gauss(int s) {
  const Hbvm<S> method = make_hbvm<S>(s, s);
  return {method.A, method.b, method.c};
}

template <class S>
class RungeKuttaTest : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
  const S tolerance = 1'000 * epsilon<S>();

  int order_of(const Tableau& tableau) const { return order(make_runge_kutta<S>(tableau), tolerance); }
  void expect_zero(const S& defect, const char* what, int s) const { EXPECT_LE(defect, tolerance) << what << " " << s; }
  void expect_nonzero(const S& defect, const char* what) const { EXPECT_GE(defect, literal<S>("1e-3")) << what; }
};
TYPED_TEST_SUITE(RungeKuttaTest, AllScalars, ScalarNames);

TYPED_TEST(RungeKuttaTest, EntriesAreRoundedOnce) {
  using S = TypeParam;
  const auto method = make_runge_kutta<S>(radau_iia());
  EXPECT_EQ(method.stages(), 2);
  EXPECT_EQ(method.A(0, 0), literal<S>("5/12"));
  EXPECT_EQ(method.A(0, 1), literal<S>("-1/12"));
  EXPECT_EQ(method.A(1, 0), literal<S>("3/4"));
  EXPECT_EQ(method.b[1], literal<S>("1/4"));
  EXPECT_EQ(method.c[0], literal<S>("1/3"));
}

TYPED_TEST(RungeKuttaTest, NamesTheEntryWithoutAValue) {
  const auto refusal = [](const Tableau& t) {
    try {
      make_runge_kutta<TypeParam>(t);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(refusal(tableau({{"0", "0"}, {"1/0", "0"}}, {"1", "0"}, {"0", "0"})).starts_with("A[2][1] "));
  EXPECT_TRUE(refusal(tableau({{"0"}}, {"sqrt(-1)"}, {"0"})).starts_with("b[1] "));
  EXPECT_TRUE(refusal(tableau({{"0"}}, {"1"}, {"x"})).starts_with("c[1] "));
  EXPECT_NE(refusal(tableau({}, {}, {})), "");
  EXPECT_NE(refusal(tableau({{"0"}, {"0"}}, {"1"}, {"0"})), "");
  EXPECT_NE(refusal(tableau({{"0", "0"}, {"0"}}, {"1", "0"}, {"0", "0"})), "");
  EXPECT_NE(refusal(tableau({{"0"}}, {"1"}, {})), "");
}

TYPED_TEST(RungeKuttaTest, OrdersOfKnownMethods) {
  EXPECT_EQ(this->order_of(tableau({{"0"}}, {"1"}, {"0"})), 1) << "explicit Euler";
  EXPECT_EQ(this->order_of(tableau({{"1"}}, {"1"}, {"1"})), 1) << "implicit Euler";
  EXPECT_EQ(this->order_of(tableau({{"1/2"}}, {"1"}, {"1/2"})), 2) << "implicit midpoint rule";
  EXPECT_EQ(this->order_of(tableau({{"0", "0"}, {"1", "0"}}, {"1/2", "1/2"}, {"0", "1"})), 2) << "Heun";
  EXPECT_EQ(this->order_of(radau_iia()), 3);
  EXPECT_EQ(this->order_of(rk4()), 4);
  EXPECT_EQ(this->order_of(dopri5()), 5);
  EXPECT_EQ(this->order_of(tableau({{"0"}}, {"1/2"}, {"0"})), 0) << "not consistent";
}

/// The largest defects of the orders 5, 6 and 7 are known in fractions, from trees grown leaf by leaf instead.
TYPED_TEST(RungeKuttaTest, ClassicalMethodFailsInOrderFive) {
  using S = TypeParam;
  const auto defects = order_defects(make_runge_kutta<S>(rk4()), 7);
  ASSERT_EQ(defects.size(), 7u);
  for (int p = 1; p <= 4; ++p) EXPECT_LE(defects[static_cast<std::size_t>(p - 1)], epsilon<S>()) << p;
  EXPECT_LE(magnitude(S(defects[4] - literal<S>("1/80"))), epsilon<S>());
  EXPECT_LE(magnitude(S(defects[5] - literal<S>("1/48"))), epsilon<S>());
  EXPECT_LE(magnitude(S(defects[6] - literal<S>("23/672"))), epsilon<S>());
}

TYPED_TEST(RungeKuttaTest, GaussMethodsAreOfOrderTwiceTheirStages) {
  using S = TypeParam;
  for (int s = 1; s <= 6; ++s) {
    const RungeKutta<S> method = gauss<S>(s);
    EXPECT_EQ(order(method, this->tolerance), 2 * s);
    this->expect_zero(symmetry_defect(method), "symmetry", s);
    this->expect_zero(symplecticity_defect(method), "symplecticity", s);
    this->expect_zero(condition_B(method, 2 * s), "B", s);
    this->expect_zero(condition_C(method, s), "C", s);
    this->expect_zero(condition_D(method, s), "D", s);
    EXPECT_GT(condition_B(method, 2 * s + 1), this->tolerance) << s;
    EXPECT_GT(condition_C(method, s + 1), this->tolerance) << s;
    EXPECT_GT(condition_D(method, s + 1), this->tolerance) << s;
  }
}

TYPED_TEST(RungeKuttaTest, ButchersTheoremGoesBeyondTheTrees) {
  using S = TypeParam;
  for (const int s : {7, 8, 9}) EXPECT_EQ(order(gauss<S>(s), this->tolerance), 2 * s);
}

TYPED_TEST(RungeKuttaTest, RadauIsNeitherSymmetricNorSymplectic) {
  const auto method = make_runge_kutta<TypeParam>(radau_iia());
  this->expect_nonzero(symmetry_defect(method), "symmetry");
  this->expect_nonzero(symplecticity_defect(method), "symplecticity");
  this->expect_zero(condition_B(method, 3), "B", 2);
  this->expect_zero(condition_C(method, 2), "C", 2);
  this->expect_zero(condition_D(method, 1), "D", 2);
  this->expect_nonzero(condition_B(method, 4), "B(4)");
  this->expect_nonzero(condition_C(method, 3), "C(3)");
  this->expect_nonzero(condition_D(method, 2), "D(2)");
  EXPECT_EQ(condition_B(method, 0), 0);
}

TYPED_TEST(RungeKuttaTest, TrapezoidalRuleIsSymmetricButNotSymplectic) {
  const auto method = make_runge_kutta<TypeParam>(tableau({{"0", "0"}, {"1/2", "1/2"}}, {"1/2", "1/2"}, {"0", "1"}));
  EXPECT_EQ(symmetry_defect(method), 0);
  EXPECT_EQ(symplecticity_defect(method), literal<TypeParam>("1/4"));
}

TYPED_TEST(RungeKuttaTest, NodesThatAreNoRowSumsShowInC) {
  const auto method = make_runge_kutta<TypeParam>(tableau({{"1/2"}}, {"1"}, {"1/3"}));
  EXPECT_LE(magnitude(TypeParam(condition_C(method, 1) - literal<TypeParam>("1/6"))), epsilon<TypeParam>());
}

TYPED_TEST(RungeKuttaTest, WhatIsNotANumberFulfilsNothing) {
  RungeKutta<TypeParam> method = gauss<TypeParam>(2);
  method.A(0, 1) = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_EQ(order(method, this->tolerance), 1);
  EXPECT_FALSE(is_finite(order_defects(method, 3)[2]));
  EXPECT_FALSE(is_finite(symmetry_defect(method)));
}

TYPED_TEST(RungeKuttaTest, RefusesOrdersBeyondTheTrees) {
  const auto method = make_runge_kutta<TypeParam>(rk4());
  EXPECT_THROW(order_defects(method, max_tree_order + 1), InputError);
  EXPECT_THROW(order_defects(method, -1), InputError);
  EXPECT_TRUE(order_defects(method, 0).empty());
}

TEST(RungeKuttaPrecision, FiftyDigitsShowWhatDoubleCannot) {
  Tableau off = rk4();
  off.A[2][1] = Expression::parse("1/2+1e-25");
  EXPECT_EQ(order(make_runge_kutta<double>(off), 1'000 * epsilon<double>()), 4);
  const PrecisionScope digits(50);
  const Mpfr tolerance = 1'000 * epsilon<Mpfr>();
  // One entry alone breaks its row's sum, and so the tree of order 2, by b_3 1e-25.
  const auto method = make_runge_kutta<Mpfr>(off);
  EXPECT_EQ(order(method, tolerance), 1);
  const Mpfr defect = order_defects(method, 2)[1];
  EXPECT_LE(magnitude(Mpfr(defect - literal<Mpfr>("1e-25/3"))), epsilon<Mpfr>());
  EXPECT_EQ(mpfr_get_prec(raw(defect)), mpfr_working_bits());
  // With the sum kept, the tree without branches of order 3 shows it, by b_3 c_2 1e-25.
  off.A[2][0] = Expression::parse("-1e-25");
  const auto balanced = make_runge_kutta<Mpfr>(off);
  EXPECT_EQ(order(balanced, tolerance), 2);
  EXPECT_LE(magnitude(Mpfr(order_defects(balanced, 3)[2] - literal<Mpfr>("1e-25/6"))), epsilon<Mpfr>());
  EXPECT_EQ(order(balanced, literal<Mpfr>("1e-20")), 4);
}

TEST(RootedTrees, AreAllThereOnce) {
  const std::vector<RootedTree> trees = rooted_trees(max_tree_order);
  std::vector<int> counts(max_tree_order, 0);
  std::set<std::vector<int>> seen;
  for (const RootedTree& tree : trees) {
    ++counts[static_cast<std::size_t>(tree.order - 1)];
    EXPECT_TRUE(seen.insert(tree.subtrees).second);
    EXPECT_TRUE(std::is_sorted(tree.subtrees.rbegin(), tree.subtrees.rend()));
    int order = 1;
    long density = 1;
    for (const int t : tree.subtrees) {
      order += trees[static_cast<std::size_t>(t)].order;
      density *= trees[static_cast<std::size_t>(t)].density;
    }
    EXPECT_EQ(tree.order, order);
    EXPECT_EQ(tree.density, density * order);
  }
  EXPECT_EQ(counts, (std::vector<int>{1, 1, 2, 4, 9, 20, 48, 115, 286, 719}));
  EXPECT_EQ(trees.size(), 1205u);
  long factorial = 1;
  for (int n = 1; n <= max_tree_order; ++n) factorial *= n;
  long highest = 0;
  for (const RootedTree& tree : trees) highest = std::max(highest, tree.density);
  EXPECT_EQ(highest, factorial) << "the tree without branches";
}

}  // namespace
}  // namespace hbvm
