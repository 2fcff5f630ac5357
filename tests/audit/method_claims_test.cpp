#include <gtest/gtest.h>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

const Claim* find(const std::vector<Claim>& claims, Quantity quantity, const std::string& problem) {
  for (const Claim& claim : claims)
    if (claim.quantity == quantity && claim.problem == problem) return &claim;
  return nullptr;
}

TEST(MethodClaims, AreWhatTheMethodSaysOfItself) {
  const auto claims = method_claims(parse_method("energy_momentum"));
  const Claim* const q = find(claims, Quantity::q, "kepler");
  ASSERT_TRUE(q);
  EXPECT_EQ(q->predicted, 2);
  EXPECT_EQ(q->form, Form::at_least);
  for (const char* const problem : {"modified_pendulum", "kepler"})
    EXPECT_EQ(find(claims, Quantity::H, problem)->form, Form::round_off);
  EXPECT_EQ(find(claims, Quantity::angular_momentum, "tethered_satellites")->form, Form::round_off);
  EXPECT_EQ(find(claims, Quantity::lagmul, "double_pendulum")->predicted, 1);
  EXPECT_EQ(find(claims, Quantity::hidden, "double_pendulum")->form, Form::at_least);
  EXPECT_FALSE(find(claims, Quantity::g, "kepler"));
}

/// The energy that is lost, and the momenta that a scaling changes, have an order.
TEST(MethodClaims, SayWhatIsLost) {
  const auto projected = method_claims(parse_method("projected_hbvm:5,2")),
             restored = method_claims(parse_method("restored_hbvm:2,2")),
             rattle = method_claims(parse_method("rattle")), hbvm = method_claims(parse_method("hbvm:4,2"));
  EXPECT_EQ(find(projected, Quantity::H, "modified_pendulum")->predicted, 5);
  EXPECT_EQ(find(projected, Quantity::hidden, "modified_pendulum")->form, Form::round_off);
  EXPECT_FALSE(find(projected, Quantity::reversal, "modified_pendulum"));
  EXPECT_EQ(find(restored, Quantity::H, "modified_pendulum")->form, Form::round_off);
  EXPECT_EQ(find(restored, Quantity::angular_momentum, "kepler")->predicted, 4);
  EXPECT_EQ(find(rattle, Quantity::H, "kepler")->predicted, 2);
  EXPECT_EQ(find(rattle, Quantity::p, "double_pendulum")->predicted, 2);
  EXPECT_EQ(find(hbvm, Quantity::H, "kepler")->predicted, 8);
  EXPECT_EQ(find(hbvm, Quantity::p, "double_pendulum")->predicted, 2);
  EXPECT_THROW(method_claims(parse_method("hbvm:auto,2")), InputError);
}

/// The audit bears them out, and finds them out where the method is another.
TEST(MethodClaims, HoldOfTheirMethodsOnly) {
  std::vector<Claim> claims = method_claims(parse_method("restored_hbvm:1,1"));
  std::erase_if(claims, [](const Claim& claim) { return claim.problem != "modified_pendulum"; });
  ASSERT_GE(claims.size(), 6U);
  for (const Finding& finding : audit(claims, {}))
    EXPECT_EQ(finding.verdict, Verdict::holds) << name_of(finding.claim.quantity) << ": " << finding.reason;
  std::erase_if(claims, [](const Claim& claim) { return claim.quantity != Quantity::H; });
  claims.front().method = parse_method("projected_hbvm:1,1");
  EXPECT_EQ(audit(claims, {}).front().verdict, Verdict::fails);
}

}  // namespace
}  // namespace hbvm::core
