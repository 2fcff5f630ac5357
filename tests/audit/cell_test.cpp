#include "audit/cell.hpp"

#include <gtest/gtest.h>

#include "audit/cells.hpp"
#include "clock.hpp"

namespace hbvm::core {
namespace {

TEST(AuditCells, AskForWhatIsClaimed) {
  const Cell cell = cell_of("kepler", {2, 2}, {Quantity::q, Quantity::H});
  EXPECT_TRUE(cell.asks_for(Quantity::q));
  EXPECT_TRUE(cell.asks_for(Quantity::H));
  EXPECT_FALSE(cell.asks_for(Quantity::p));
  EXPECT_EQ(cell.subject().quantity, Quantity::q);
}

TEST(AuditCells, NeedNoReferenceOfMoreThanTwentyStages) {
  EXPECT_EQ(cell_of("kepler", {30, 3}, {Quantity::q}).stages(), 3);
  EXPECT_EQ(cell_of("kepler", {20, 20}, {Quantity::q}).stages(), 20);
  EXPECT_EQ(cell_of("kepler", {30, 25}, {Quantity::q}).stages(), 20);
}

/// The finest rung of what is asked for counts, and a better reference might still show it.
TEST(AuditCells, AreLostInRoundOff) {
  const Cell cell = cell_of("kepler", {2, 2}, {Quantity::q, Quantity::p});
  const Rung clean{-3, -20, -50}, lost{-4, -51, -50}, by_reference{-4, -51, -50, true};
  EXPECT_TRUE(cell.is_lost({{Quantity::q, {clean, lost}}, {Quantity::p, {clean, lost}}}));
  EXPECT_FALSE(cell.is_lost({{Quantity::q, {clean, lost}}, {Quantity::p, {lost, clean}}}));
  EXPECT_FALSE(cell.is_lost({{Quantity::q, {clean, by_reference}}, {Quantity::p, {lost}}}));
  EXPECT_TRUE(cell.is_lost({{Quantity::q, {lost}}, {Quantity::H, {clean}}})) << "nobody asks for H";
}

TEST(AuditCells, StopAtTheirLimit) {
  Cell cell = cell_of("kepler", {2, 2}, {Quantity::q});
  EXPECT_NO_THROW(cell.check_time());
  cell.stop_at = thread_seconds() + 1000;
  EXPECT_NO_THROW(cell.check_time());
  cell.stop_at = thread_seconds() / 2;
  EXPECT_THROW(cell.check_time(), LimitReached);
}

}  // namespace
}  // namespace hbvm::core
