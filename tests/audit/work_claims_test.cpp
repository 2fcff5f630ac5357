#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "audit/claims.hpp"
#include "problem/problem.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using ClaimKey = std::tuple<Quantity, std::string, std::string, Span, Form, double>;

ClaimKey key_of_claim(const Claim& c) { return {c.quantity, c.problem, c.method->text(), c.span, c.form, c.predicted}; }

TEST(WorkClaims, AreMadeOnceAndQuickOnesAreAmongTheFullOnes) {
  std::set<ClaimKey> full;
  for (const Claim& claim : work_claims(Extent::full))
    EXPECT_TRUE(full.insert(key_of_claim(claim)).second) << claim.problem << claim.method_text();
  const std::vector<Claim> quick = work_claims(Extent::quick);
  EXPECT_GE(full.size(), 6 * quick.size());
  for (const Claim& claim : quick) EXPECT_TRUE(full.contains(key_of_claim(claim))) << claim.problem;
}

/// Of s = 1 .. 6, each order that the line integral has with work, and none about motions that need no account of it.
TEST(WorkClaims, AreAboutForcesWithoutAPotential) {
  std::set<std::string> scenes;
  std::set<int> stages;
  std::set<Quantity> quantities;
  for (const Claim& claim : work_claims(Extent::full)) {
    scenes.insert(claim.problem);
    stages.insert(claim.method->stages());
    quantities.insert(claim.quantity);
    const auto [k, s, r] = as_hbvm(*claim.method)->name();
    const int more = claim.span == Span::step ? 1 : 0;
    if (claim.form != Form::at_least) continue;
    if (claim.quantity == Quantity::q || claim.quantity == Quantity::tangential_p) {
      EXPECT_EQ(claim.predicted, 2 * s + more);
    }
    if (claim.quantity == Quantity::balance) {
      EXPECT_EQ(claim.predicted, 2 * k + more);
    }
    if (claim.quantity == Quantity::g) {
      EXPECT_EQ(claim.predicted, 2 * r + more);
    }
  }
  EXPECT_EQ(stages, (std::set<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(scenes.size(), 6u);
  for (const std::string& name : scenes)
    EXPECT_FALSE(assemble<double>(load_scene(name)).problem.is_conservative()) << name;
  for (const Quantity quantity : {Quantity::q, Quantity::p, Quantity::tangential_p, Quantity::output_lambda,
                                  Quantity::g, Quantity::hidden, Quantity::H, Quantity::balance, Quantity::reversal})
    EXPECT_TRUE(quantities.contains(quantity)) << name_of(quantity);
}

/// H is claimed where no force does work, and there alone.
TEST(WorkClaims, SayWhereHIsKept) {
  for (const Claim& claim : work_claims(Extent::full))
    if (claim.quantity == Quantity::H) {
      EXPECT_EQ(claim.form, Form::round_off);
      EXPECT_TRUE(assemble<double>(load_scene(claim.problem)).problem.driven.empty()) << claim.problem;
    }
}

}  // namespace
}  // namespace hbvm::core
