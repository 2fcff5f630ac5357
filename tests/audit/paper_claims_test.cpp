#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "scene/scene.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

int k_of(const Claim& claim) { return as_hbvm(*claim.method)->name().k; }
int s_of(const Claim& claim) { return as_hbvm(*claim.method)->name().s; }

constexpr Extent both[] = {Extent::quick, Extent::full};

std::set<std::string> labels(Extent extent) {
  std::set<std::string> found;
  for (const Claim& claim : paper_claims(extent)) found.insert(claim.label);
  return found;
}
/// All of a claim but its k.
auto but_k(const Claim& c) {
  return std::tuple(c.label, c.quantity, c.problem, s_of(c), c.span, c.form, c.predicted, c.tolerance);
}

TEST(PaperClaims, QuickOnesAreFewer) {
  EXPECT_GE(paper_claims(Extent::quick).size(), 40u);
  EXPECT_GT(paper_claims(Extent::full).size(), paper_claims(Extent::quick).size());
}

TEST(PaperClaims, CoverTheStatements) {
  for (const Extent extent : both) {
    const auto found = labels(extent);
    for (const char* const label :
         {"gheq0", "evai", "dlamj", "ord2s", "norm", "ordlam", "hidcons", "evaik", "simme", "superconvergence",
          "ord2sk", "normk", "ordlamk", "hidden constant", "angular momentum, k = s", "no constraints", "coefficients"})
      EXPECT_TRUE(found.contains(label)) << label;
  }
}

/// The sweeps are counted with four nodes more than stages, which the quick ones do not go up to.
TEST(PaperClaims, CostIsClaimedInFull) {
  EXPECT_TRUE(labels(Extent::full).contains("costo"));
  EXPECT_FALSE(labels(Extent::quick).contains("costo"));
}

TEST(PaperClaims, EveryQuantityIsClaimedInFull) {
  std::set<Quantity> found;
  for (const Claim& claim : paper_claims(Extent::full)) found.insert(claim.quantity);
  for (int n = 0; n <= static_cast<int>(Quantity::W); ++n) {
    const auto quantity = static_cast<Quantity>(n);
    const bool of_others = quantity == Quantity::order_conditions || quantity == Quantity::balance ||
                           quantity == Quantity::q_between || quantity == Quantity::p_between ||
                           quantity == Quantity::lambda_between;
    EXPECT_EQ(found.contains(quantity), !of_others) << name_of(quantity);
  }
}

TEST(PaperClaims, StagesAndNodes) {
  std::map<int, int> most_k;
  for (const Claim& claim : paper_claims(Extent::full)) {
    EXPECT_GE(k_of(claim), s_of(claim));
    // U of degree 4 takes k = 2 s, and one less is not enough.
    if (!claim.problem.starts_with("quartic")) most_k[s_of(claim)] = std::max(most_k[s_of(claim)], k_of(claim));
  }
  const std::map<int, int> expected{{1, 5},  {2, 6},  {3, 7},  {4, 8},   {5, 9},
                                    {6, 10}, {7, 11}, {8, 12}, {12, 12}, {20, 20}};
  EXPECT_EQ(most_k, expected);
  for (const Claim& claim : paper_claims(Extent::quick)) EXPECT_LE(s_of(claim), 3);
}

TEST(PaperClaims, ManyStagesAreLookedAtInManyDigits) {
  for (const Extent extent : both)
    for (const Claim& claim : paper_claims(extent)) {
      const bool many = s_of(claim) > 8 && claim.problem != "tableau";
      EXPECT_EQ(claim.least_digits, many ? 200u : 0u) << key_of(claim);
    }
}

TEST(PaperClaims, AreAllDifferent) {
  for (const Extent extent : both) {
    std::set<std::string> keys;
    for (const Claim& claim : paper_claims(extent)) EXPECT_TRUE(keys.insert(key_of(claim)).second) << key_of(claim);
  }
}

/// What is claimed for k = s + 1 in the quick ones is claimed for s + 2 in full.
TEST(PaperClaims, QuickOnesAreInFullUpToK) {
  std::set<std::string> keys;
  std::set<std::tuple<std::string, Quantity, std::string, int, Span, Form, double, double>> others;
  for (const Claim& claim : paper_claims(Extent::full)) {
    keys.insert(key_of(claim));
    if (k_of(claim) == s_of(claim) + 2) others.insert(but_k(claim));
  }
  for (const Claim& claim : paper_claims(Extent::quick)) {
    const bool moved = k_of(claim) == s_of(claim) + 1 && others.contains(but_k(claim));
    EXPECT_TRUE(keys.contains(key_of(claim)) || moved) << key_of(claim);
  }
}

TEST(PaperClaims, ProblemsAreBuiltIn) {
  std::set<std::string> scenes{"tableau"};
  for (const auto& [name, text] : built_in_scenes()) scenes.insert(name);
  for (const Claim& claim : paper_claims(Extent::full)) EXPECT_TRUE(scenes.contains(claim.problem)) << claim.problem;
}

TEST(PaperClaims, OrdersAreThoseOfTheTheorems) {
  for (const Claim& claim : paper_claims(Extent::full)) {
    const int s = s_of(claim), one = claim.span == Span::step ? 1 : 0;
    const int even = s + s % 2;
    if (claim.label == "superconvergence" || claim.label == "ord2s, dli0" || claim.label == "no constraints") {
      EXPECT_EQ(claim.predicted, 2 * s + one) << key_of(claim);
    }
    if (claim.label == "ord2s" || claim.label == "ord2sk") {
      EXPECT_EQ(claim.predicted, even) << key_of(claim);
    }
    if (claim.label == "hidcons") {
      EXPECT_EQ(claim.predicted, claim.span == Span::step ? s + 1 : even) << key_of(claim);
    }
    if (claim.label == "ordlam" || claim.label == "ordlamk") {
      EXPECT_EQ(claim.predicted, even - 1) << key_of(claim);
    }
    if (claim.label == "dlamj") {
      EXPECT_EQ(claim.predicted, s) << key_of(claim);
    }
    if (claim.label == "evaik") {
      EXPECT_EQ(claim.predicted, 2 * k_of(claim) + one) << key_of(claim);
    }
  }
}

/// A bound is one from above; only where the Gram matrix is constant the leading term is known.
TEST(PaperClaims, AreExactWhereTheLeadingTermIsKnown) {
  for (const Claim& claim : paper_claims(Extent::full))
    if (claim.form == Form::exactly) {
      EXPECT_TRUE(claim.problem == "modified_pendulum" || claim.problem == "tethered_satellites") << key_of(claim);
      EXPECT_TRUE(claim.quantity == Quantity::p || claim.quantity == Quantity::hidden) << key_of(claim);
    }
}

}  // namespace
}  // namespace hbvm::core
