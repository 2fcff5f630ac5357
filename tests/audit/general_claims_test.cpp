#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

auto key(const Claim& c) { return std::tuple(c.quantity, c.problem, c.method->text(), c.span, c.form, c.predicted); }

TEST(GeneralClaims, AreMadeOnce) {
  for (const Extent extent : {Extent::quick, Extent::full}) {
    std::set<decltype(key(Claim{}))> seen;
    for (const Claim& claim : general_claims(extent))
      EXPECT_TRUE(seen.insert(key(claim)).second) << claim.method_text();
  }
}

TEST(GeneralClaims, QuickOnesAreAmongTheFullOnes) {
  std::set<decltype(key(Claim{}))> full;
  for (const Claim& claim : general_claims(Extent::full)) full.insert(key(claim));
  const auto quick = general_claims(Extent::quick);
  EXPECT_GE(quick.size(), 100u);
  EXPECT_GT(full.size(), 4 * quick.size());
  for (const Claim& claim : quick) EXPECT_TRUE(full.contains(key(claim))) << claim.method_text() << claim.problem;
}

/// Of scenes that are not quadratic, with the nodes said, and every quantity that the study speaks of.
TEST(GeneralClaims, AreAboutConstraintsThatAreNotQuadratic) {
  std::set<Quantity> quantities;
  for (const Claim& claim : general_claims(Extent::full)) {
    EXPECT_NE(degree(assemble<double>(load_scene(claim.problem)).problem.constraints), 2) << claim.problem;
    const HbvmName& name = as_hbvm(*claim.method)->name();
    EXPECT_GE(name.r, name.s);
    quantities.insert(claim.quantity);
  }
  for (const Quantity quantity :
       {Quantity::q, Quantity::p, Quantity::tangential_p, Quantity::output_lambda, Quantity::g, Quantity::hidden,
        Quantity::H, Quantity::angular_momentum, Quantity::reversal})
    EXPECT_TRUE(quantities.contains(quantity)) << name_of(quantity);
}

/// The order of g is that of its nodes, whatever those of U; a degree that the nodes integrate leaves round-off.
TEST(GeneralClaims, SayWhatTheNodesKeep) {
  for (const Claim& claim : general_claims(Extent::full)) {
    const auto [k, s, r] = as_hbvm(*claim.method)->name();
    if (claim.quantity == Quantity::g && claim.form == Form::at_least) {
      EXPECT_EQ(claim.predicted, 2 * r + (claim.span == Span::step ? 1 : 0));
    }
    if (claim.quantity == Quantity::g && claim.form == Form::round_off) {
      EXPECT_EQ(claim.problem, "bead_on_quartic");
      EXPECT_GE(2 * r, 4 * s);
    }
    if (claim.quantity == Quantity::H && claim.form == Form::at_least) {
      EXPECT_EQ(claim.predicted, 2 * k + (claim.span == Span::step ? 1 : 0));
    }
    if (claim.quantity == Quantity::angular_momentum) {
      EXPECT_EQ(claim.form == Form::round_off, k == s && r == s) << claim.method_text();
    }
  }
}

}  // namespace
}  // namespace hbvm::core
