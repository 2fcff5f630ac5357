#include "method/order_conditions.hpp"

#include <limits>

#include "hbvm/error.hpp"
#include "method/symmetry_defect.hpp"
#include "method/tableaux.hpp"

namespace hbvm::core {
namespace {

template <class S>
using OrderConditionsTest = TableauTest<S>;
TYPED_TEST_SUITE(OrderConditionsTest, AllScalars, ScalarNames);

TYPED_TEST(OrderConditionsTest, OrdersOfKnownMethods) {
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
TYPED_TEST(OrderConditionsTest, ClassicalMethodFailsInOrderFive) {
  using S = TypeParam;
  const auto defects = order_defects(make_runge_kutta<S>(rk4()), 7);
  ASSERT_EQ(defects.size(), 7u);
  for (int p = 1; p <= 4; ++p) EXPECT_LE(defects[static_cast<std::size_t>(p - 1)], epsilon<S>()) << p;
  EXPECT_LE(magnitude(S(defects[4] - literal<S>("1/80"))), epsilon<S>());
  EXPECT_LE(magnitude(S(defects[5] - literal<S>("1/48"))), epsilon<S>());
  EXPECT_LE(magnitude(S(defects[6] - literal<S>("23/672"))), epsilon<S>());
}

TYPED_TEST(OrderConditionsTest, GaussMethodsAreOfOrderTwiceTheirStages) {
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

TYPED_TEST(OrderConditionsTest, ButchersTheoremGoesBeyondTheTrees) {
  using S = TypeParam;
  for (const int s : {7, 8, 9}) EXPECT_EQ(order(gauss<S>(s), this->tolerance), 2 * s);
}

TYPED_TEST(OrderConditionsTest, NodesThatAreNoRowSumsShowInC) {
  const auto method = make_runge_kutta<TypeParam>(tableau({{"1/2"}}, {"1"}, {"1/3"}));
  EXPECT_LE(magnitude(TypeParam(condition_C(method, 1) - literal<TypeParam>("1/6"))), epsilon<TypeParam>());
}

TYPED_TEST(OrderConditionsTest, WhatIsNotANumberFulfilsNothing) {
  RungeKutta<TypeParam> method = gauss<TypeParam>(2);
  method.A(0, 1) = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_EQ(order(method, this->tolerance), 1);
  EXPECT_FALSE(is_finite(order_defects(method, 3)[2]));
  EXPECT_FALSE(is_finite(symmetry_defect(method)));
}

TYPED_TEST(OrderConditionsTest, RefusesOrdersBeyondTheTrees) {
  const auto method = make_runge_kutta<TypeParam>(rk4());
  EXPECT_THROW(order_defects(method, max_tree_order + 1), InputError);
  EXPECT_THROW(order_defects(method, -1), InputError);
  EXPECT_TRUE(order_defects(method, 0).empty());
}

TEST(RungeKuttaPrecision, FiftyDigitsShowWhatDoubleCannot) {
  Tableau off = rk4();
  off.A[2][1] = "1/2+1e-25";
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
  off.A[2][0] = "-1e-25";
  const auto balanced = make_runge_kutta<Mpfr>(off);
  EXPECT_EQ(order(balanced, tolerance), 2);
  EXPECT_LE(magnitude(Mpfr(order_defects(balanced, 3)[2] - literal<Mpfr>("1e-25/6"))), epsilon<Mpfr>());
  EXPECT_EQ(order(balanced, literal<Mpfr>("1e-20")), 4);
}

}  // namespace
}  // namespace hbvm::core
