#include "audit/claim_group.hpp"

#include <gtest/gtest.h>

#include "audit/claim_groups.hpp"
#include "clock.hpp"

namespace hbvm::core {
namespace {

TEST(AuditCells, AskForWhatIsClaimed) {
  const ClaimGroup group = group_of("kepler", {2, 2}, {Quantity::q, Quantity::H});
  EXPECT_TRUE(group.asks_for(Quantity::q));
  EXPECT_TRUE(group.asks_for(Quantity::H));
  EXPECT_FALSE(group.asks_for(Quantity::p));
  EXPECT_EQ(group.subject().quantity, Quantity::q);
}

TEST(AuditCells, NeedNoReferenceOfMoreThanTwentyStages) {
  EXPECT_EQ(group_of("kepler", {30, 3}, {Quantity::q}).stages(), 3);
  EXPECT_EQ(group_of("kepler", {20, 20}, {Quantity::q}).stages(), 20);
  EXPECT_EQ(group_of("kepler", {30, 25}, {Quantity::q}).stages(), 20);
}

/// The finest rung of what is asked for counts, and a better reference might still show it.
TEST(AuditCells, AreLostInRoundOff) {
  const ClaimGroup group = group_of("kepler", {2, 2}, {Quantity::q, Quantity::p});
  const Rung clean{-3, -20, -50}, lost{-4, -51, -50}, by_reference{-4, -51, -50, true};
  EXPECT_TRUE(group.is_lost({{Quantity::q, {clean, lost}}, {Quantity::p, {clean, lost}}}));
  EXPECT_FALSE(group.is_lost({{Quantity::q, {clean, lost}}, {Quantity::p, {lost, clean}}}));
  EXPECT_FALSE(group.is_lost({{Quantity::q, {clean, by_reference}}, {Quantity::p, {lost}}}));
  EXPECT_TRUE(group.is_lost({{Quantity::q, {lost}}, {Quantity::H, {clean}}})) << "nobody asks for H";
}

TEST(AuditCells, StopAtTheirLimit) {
  ClaimGroup group = group_of("kepler", {2, 2}, {Quantity::q});
  EXPECT_NO_THROW(group.check_time());
  group.stop_at = thread_seconds() + 1000;
  EXPECT_NO_THROW(group.check_time());
  group.stop_at = thread_seconds() / 2;
  EXPECT_THROW(group.check_time(), LimitReached);
}

}  // namespace
}  // namespace hbvm::core
