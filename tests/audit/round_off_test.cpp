#include <gtest/gtest.h>

#include <cmath>

#include "audit/claim_groups.hpp"
#include "audit/measurements.hpp"

namespace hbvm::core {
namespace {

constexpr ConservationRun short_run{-4, 24};

TEST(RoundOffAllowed, IsFourUnitsForEachNumberSummed) {
  EXPECT_EQ(allowed_units(group_of("kepler", {5, 3}, {Quantity::H}).subject()), 32);
}

TEST(RoundOffAllowed, ExplainsWhatGaussConserves) {
  const auto found = round_off<double>(
      group_of("kepler", {3, 3}, {Quantity::angular_momentum, Quantity::reversal, Quantity::H}), short_run);
  for (const Quantity quantity : {Quantity::angular_momentum, Quantity::reversal}) {
    EXPECT_LE(found.at(quantity).ratio, 1) << name_of(quantity);
    EXPECT_EQ(found.at(quantity).rung.step, -4);
  }
  EXPECT_GT(found.at(Quantity::H).ratio, 1000) << "of order 6, not exact";
  EXPECT_FALSE(found.contains(Quantity::hidden));
}

/// The same error is more and more beyond round-off as the digits grow.
TEST(RoundOffAllowed, IsThatOfThePrecision) {
  const ClaimGroup group = group_of("double_pendulum", {2, 2}, {Quantity::hidden, Quantity::g});
  const auto in_double = round_off<double>(group, short_run), in_quad = round_off<Quad>(group, short_run);
  EXPECT_LE(in_double.at(Quantity::g).ratio, 1);
  EXPECT_LE(in_quad.at(Quantity::g).ratio, 1);
  EXPECT_GT(in_double.at(Quantity::hidden).ratio, 1000);
  EXPECT_NEAR(std::log2(in_quad.at(Quantity::hidden).ratio / in_double.at(Quantity::hidden).ratio),
              significand_bits<Quad>() - significand_bits<double>(), 1);
}

}  // namespace
}  // namespace hbvm::core
