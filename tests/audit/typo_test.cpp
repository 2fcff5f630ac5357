#include "audit/typo.hpp"

#include "method/tableaux.hpp"

namespace hbvm::core {
namespace {

/// An entry of the classical method and of Dormand and Prince's with a wrong digit: it is found, with what it should
/// be.
TEST(Typo, IsTheEntryThatKeepsAMethodFromItsOrder) {
  Tableau classical = rk4();
  classical.b[2] = "0.3343";
  const std::optional<Typo> in_b = typo_of(classical, 0, 30);
  ASSERT_TRUE(in_b);
  EXPECT_EQ(in_b->entry, "b[3]");
  EXPECT_EQ(in_b->order, 4);
  EXPECT_EQ(in_b->expected.substr(0, 5), "3.333");
  Tableau pair = dopri5();
  pair.A[4][2] = "64448/6561 + 1/1000";
  const std::optional<Typo> in_A = typo_of(pair, 1, 30);
  ASSERT_TRUE(in_A);
  EXPECT_EQ(in_A->entry, "A[5][3]");
  EXPECT_EQ(in_A->order, 5);
}

TEST(Typo, IsNoneOfARightMethod) {
  EXPECT_FALSE(typo_of(rk4(), 4, 30));
  EXPECT_FALSE(is_nearly_of_next_order(rk4(), 4));
  EXPECT_FALSE(is_nearly_of_next_order(dopri5(), 5));
  EXPECT_FALSE(is_nearly_of_next_order(radau_iia(), 3));
}

TEST(Typo, IsLikelyWhereConditionsAreNearlyMet) {
  Tableau pair = dopri5();
  pair.A[4][2] = "64448/6561 + 1/100000";
  EXPECT_TRUE(is_nearly_of_next_order(pair, 1));
}

}  // namespace
}  // namespace hbvm::core
