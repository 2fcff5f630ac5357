#include <gtest/gtest.h>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

TEST(BetweenClaims, AreAboutAllStagesAndComponents) {
  EXPECT_EQ(between_claims(Extent::full).size(), 72u);
  EXPECT_EQ(between_claims(Extent::quick).size(), 24u);
}

/// They hold, and an order more does not.
TEST(BetweenClaims, AreSeenAndHaveTeeth) {
  std::vector<Claim> claims;
  for (const Claim& claim : between_claims(Extent::quick)) {
    const HbvmName& name = as_hbvm(*claim.method)->name();
    if (claim.problem != "modified_pendulum" || name.s != 2) continue;
    claims.push_back(claim);
    claims.push_back(claim);
    claims.back().predicted += 1;
    claims.back().form = Form::exactly;
  }
  ASSERT_EQ(claims.size(), 12u);
  AuditOptions options;
  const std::vector<Finding> findings = audit(claims, options);
  for (std::size_t n = 0; n < findings.size(); ++n)
    EXPECT_EQ(findings[n].verdict, n % 2 == 0 ? Verdict::holds : Verdict::fails) << n << ": " << findings[n].reason;
}

}  // namespace
}  // namespace hbvm::core
