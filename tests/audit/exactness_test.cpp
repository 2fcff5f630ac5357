#include "audit/exactness.hpp"

#include <gtest/gtest.h>

#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

std::string proof(Quantity quantity, const std::string& problem, HbvmName method) {
  Claim claim = make_claim("test", quantity, problem, Span::interval, Form::round_off, 0);
  claim.method = hbvm_of(method);
  const CoefficientCheck check(claim, 50);
  return proof_of(claim, &check);
}

TEST(Exactness, OfTheEnergyIsProvedByTheDegree) {
  EXPECT_NE(proof(Quantity::H, "double_pendulum", {3, 3}), "");
  EXPECT_NE(proof(Quantity::H, "quartic_oscillator", {4, 2}), "");
  EXPECT_EQ(proof(Quantity::H, "quartic_oscillator", {3, 2}), "");
  EXPECT_EQ(proof(Quantity::H, "kepler", {60, 1}), "");
}

TEST(Exactness, OfTheAngularMomentumIsProvedByTheNodes) {
  EXPECT_NE(proof(Quantity::angular_momentum, "kepler", {5, 5}), "");
  EXPECT_EQ(proof(Quantity::angular_momentum, "kepler", {6, 5}), "");
  EXPECT_NE(proof(Quantity::angular_momentum, "heavy_top", {6, 5}), "") << "U is linear";
}

TEST(Exactness, OfConstraintsAndReversalIsProved) {
  EXPECT_NE(proof(Quantity::g, "double_pendulum", {4, 2}), "");
  EXPECT_NE(proof(Quantity::reversal, "kepler", {4, 2}), "");
}

/// The midpoint rule is symplectic and symmetric, Euler's explicit method neither.
TEST(Exactness, OfTableauxIsProvedByTheirCoefficients) {
  const auto proof_for = [](Quantity quantity, const char* a, const std::string& problem) {
    Claim claim = make_claim("test", quantity, problem, Span::interval, Form::round_off, 0);
    claim.method = std::make_shared<const TableauMethod>(Tableau{"one stage", {{a}}, {1}, {a}}, "");
    const CoefficientCheck check(claim, 50);
    return proof_of(claim, &check);
  };
  for (const Quantity quantity : {Quantity::angular_momentum, Quantity::reversal}) {
    EXPECT_NE(proof_for(quantity, "1/2", "kepler"), "");
    EXPECT_EQ(proof_for(quantity, "0", "kepler"), "");
  }
  EXPECT_EQ(proof_for(Quantity::H, "1/2", "kepler"), "");
  EXPECT_EQ(proof_for(Quantity::H, "1/2", "quartic_oscillator"), "");
}

/// More nodes need more digits, and so does an effect that is far weaker than the others.
TEST(Exactness, NeedsDigitsForTheOrder) {
  const auto digits = [](HbvmName method) {
    Claim claim = make_claim("test", Quantity::H, "kepler", Span::interval, Form::round_off, 0);
    claim.method = hbvm_of(method);
    return digits_to_show(claim, 0);
  };
  EXPECT_LT(digits({4, 2}), 60);
  EXPECT_GT(digits({60, 1}), 300);
  EXPECT_LT(digits({60, 1}), 500);
  EXPECT_EQ(digits({60, 1}), digits({60, 2}));
}

}  // namespace
}  // namespace hbvm::core
