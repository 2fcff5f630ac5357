#include <gtest/gtest.h>

#include "audit/claim_groups.hpp"
#include "audit/measurements.hpp"
#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

double value_of_one(Quantity quantity, const char* problem, HbvmName method) {
  return special_value(group_of(problem, method, {quantity}));
}

TEST(SpecialValues, AreNotThoseThatHaveARate) {
  for (const Quantity quantity : {Quantity::q, Quantity::H, Quantity::B, Quantity::order_conditions})
    EXPECT_THROW(value_of_one(quantity, "kepler", {2, 2}), InputError) << name_of(quantity);
}

/// More nodes for the potential cost no sweeps.
TEST(SpecialValues, SweepsAreThoseBeyondTheOnesOfGauss) {
  EXPECT_EQ(value_of_one(Quantity::sweeps, "double_pendulum", {2, 2}), 0);
  EXPECT_NEAR(value_of_one(Quantity::sweeps, "double_pendulum", {6, 2}), 0, 1);
}

}  // namespace
}  // namespace hbvm::core
