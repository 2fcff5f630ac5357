#include "audit/coefficients.hpp"

#include <gtest/gtest.h>

#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

/// The Gauss method of two stages with b_1 and A_12 off by so much.
Claim gauss(const std::string& in_b = "", const std::string& in_A = "") {
  Tableau tableau{"Gauss",
                  {{"1/4", "1/4-sqrt(3)/6" + in_A}, {"1/4+sqrt(3)/6", "1/4"}},
                  {"1/2" + in_b, "1/2"},
                  {"1/2-sqrt(3)/6", "1/2+sqrt(3)/6"},
                  {}};
  Claim claim = make_claim("test", Quantity::q, "kepler", Span::interval, Form::at_least, 4);
  claim.method = std::make_shared<const TableauMethod>(std::move(tableau), "");
  return claim;
}

TEST(CoefficientCheck, SeesWhatIsRightToAllDigits) {
  const CoefficientCheck check(gauss(), 200);
  EXPECT_EQ(check.order_to(200), 4);
  EXPECT_EQ(check.order(4).seen, 200);
  EXPECT_LT(check.order(5).seen, 3);
  EXPECT_EQ(check.symplecticity().seen, 200);
  EXPECT_EQ(check.symmetry().seen, 200);
  EXPECT_EQ(check.row_sums().seen, 200);
  Claim hbvm;
  for (const HbvmName method : {HbvmName{1, 1}, {5, 3}, {20, 20}}) {
    hbvm.method = hbvm_of(method);
    EXPECT_EQ(CoefficientCheck(hbvm, 300).definition(), 300) << method.text();
  }
}

TEST(CoefficientCheck, SeesHowManyDigitsAreRight) {
  for (const int digits : {20, 60, 150}) {
    const std::string off = "+10^(-" + std::to_string(digits) + ")";
    const CoefficientCheck in_b(gauss(off), 200), in_A(gauss("", off), 200);
    EXPECT_EQ(in_b.order_to(200), 0) << "b does not sum to 1";
    EXPECT_NEAR(in_b.order(1).seen, digits, 1);
    EXPECT_EQ(in_b.row_sums().seen, 200);
    EXPECT_EQ(in_A.order_to(200), 1);
    EXPECT_EQ(in_A.order(1).seen, 200);
    EXPECT_NEAR(in_A.order(4).seen, digits, 1);
    EXPECT_EQ(in_A.order_to(digits - 2), 4);
    EXPECT_NEAR(in_A.symplecticity().seen, digits, 1);
    EXPECT_NEAR(in_A.row_sums().seen, digits, 1);
  }
}

/// Beyond the trees, by B, C and D: the Gauss method of seven stages as HBVM(7, 7) has it, written out.
TEST(CoefficientCheck, OrdersBeyondTheTreesAreSeen) {
  const PrecisionScope scope(300);
  const Hbvm<Mpfr> hbvm = make_hbvm<Mpfr>(7, 7);
  const auto exact = [](const Mpfr& x) { return x.str(0, std::ios_base::scientific); };
  Tableau tableau{"Gauss", {}, {}, {}, {}};
  for (Index i = 0; i < 7; ++i) {
    tableau.A.emplace_back();
    for (Index j = 0; j < 7; ++j) tableau.A.back().push_back(exact(hbvm.A(i, j)));
    tableau.b.push_back(exact(hbvm.b[i]));
    tableau.c.push_back(exact(hbvm.c[i]));
  }
  Claim claim = gauss();
  claim.method = std::make_shared<const TableauMethod>(tableau, "");
  const CoefficientCheck check(claim, 250);
  EXPECT_EQ(check.order_to(250), 14);
  EXPECT_LT(check.order(15).seen, 20);
}

/// The classical method of order 4 in decimals. Its conditions are met to the digits that the decimals have, and a
/// wrong digit among them is seen.
TEST(CoefficientCheck, HoldsDecimalsToTheirDigits) {
  const auto rk4 = [](const std::string& sixth, const std::string& third) {
    Tableau tableau{"decimals",
                    {{"0", "0", "0", "0"}, {"1/2", "0", "0", "0"}, {"0", "1/2", "0", "0"}, {"0", "0", "1", "0"}},
                    {sixth, third, third, sixth},
                    {"0", "1/2", "1/2", "1"},
                    {}};
    Claim claim = make_claim("test", Quantity::q, "kepler", Span::interval, Form::at_least, 4);
    claim.method = std::make_shared<const TableauMethod>(std::move(tableau), "");
    return claim;
  };
  const CoefficientCheck right(rk4("0.1666666666666666666667", "0.3333333333333333333333"), 200);
  ASSERT_TRUE(right.decimals());
  EXPECT_EQ(right.decimals()->digits, 22);
  EXPECT_EQ(right.order_found(), 4);
  EXPECT_TRUE(right.order(4).holds());
  EXPECT_FALSE(right.order(5).holds());
  const CoefficientCheck wrong(rk4("0.1666666666666667666667", "0.3333333333333333333333"), 200);
  EXPECT_EQ(wrong.order_found(), 0) << "b does not sum to 1 in the 16th digit";
  EXPECT_NEAR(wrong.order(1).seen, 15, 1);
}

}  // namespace
}  // namespace hbvm::core
