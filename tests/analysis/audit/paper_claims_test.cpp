#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "hbvm/analysis/audit/audit.hpp"
#include "hbvm/analysis/audit/claims.hpp"
#include "hbvm/step/hbvm_method.hpp"
#include "hbvm/step/tableau_method.hpp"

namespace hbvm {
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
    EXPECT_EQ(found.contains(quantity), quantity != Quantity::order_conditions) << name_of(quantity);
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

Tableau tableau(const std::vector<std::vector<std::string>>& A, const std::vector<std::string>& b,
                const std::vector<std::string>& c, std::optional<int> order = {}) {
  const auto parsed = [](const std::vector<std::string>& texts) {
    std::vector<Expression> row;
    for (const std::string& text : texts) row.push_back(Expression::parse(text));
    return row;
  };
  Tableau t{"test", {}, parsed(b), parsed(c), order};
  for (const auto& row : A) t.A.push_back(parsed(row));
  return t;
}

/// What is predicted of a quantity, at each place where it is claimed.
std::vector<double> predicted(const std::vector<Claim>& claims, Quantity quantity) {
  std::vector<double> values;
  for (const Claim& claim : claims)
    if (claim.quantity == quantity) values.push_back(claim.predicted);
  return values;
}
void expect_order(const std::vector<Claim>& claims, double order, const std::string& label) {
  EXPECT_EQ(predicted(claims, Quantity::order_conditions), std::vector<double>{order});
  for (const Quantity quantity : {Quantity::q, Quantity::p, Quantity::H})
    EXPECT_EQ(predicted(claims, quantity), (std::vector<double>{order, order})) << name_of(quantity);
  for (const Claim& claim : claims)
    if (claim.quantity == Quantity::order_conditions || claim.quantity == Quantity::q) {
      EXPECT_EQ(claim.label, label);
    }
}

TEST(TableauClaims, StatedOrderIsClaimedEvenIfItIsWrong) {
  for (const int order : {1, 2, 7})
    expect_order(tableau_claims(tableau({{"1/2"}}, {"1"}, {"1/2"}, order)), order, "stated order");
}

TEST(TableauClaims, WithoutOneTheConditionsSayIt) {
  expect_order(tableau_claims(tableau({{"1/2"}}, {"1"}, {"1/2"})), 2, "order to ten digits");
  expect_order(tableau_claims(tableau({{"5/12", "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"})), 3,
               "order to ten digits");
}

/// A mistake that double would not show is found only by the claim that what seems so is so.
TEST(TableauClaims, OrderIsThatToTenDigits) {
  const auto radau = [](const std::string& off) {
    return tableau_claims(tableau({{"5/12+" + off, "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"}));
  };
  expect_order(radau("1e-12"), 3, "order to ten digits");
  expect_order(radau("1e-8"), 1, "order to ten digits");
}

TEST(TableauClaims, SymmetryAndSymplecticityAreClaimedOfThoseThatHaveThem) {
  const auto expect = [](const Tableau& t, std::size_t symmetric, std::size_t symplectic) {
    const auto claims = tableau_claims(t);
    EXPECT_EQ(predicted(claims, Quantity::reversal).size(), symmetric);
    EXPECT_EQ(predicted(claims, Quantity::angular_momentum).size(), symplectic);
    for (const Claim& claim : claims)
      if (claim.quantity == Quantity::reversal || claim.quantity == Quantity::angular_momentum) {
        EXPECT_EQ(claim.form, Form::round_off);
      }
  };
  // On two problems each: the midpoint rule is both, the trapezoidal rule symmetric, two midpoint steps of unlike
  // length symplectic, Radau IIA neither.
  expect(tableau({{"1/2"}}, {"1"}, {"1/2"}), 2, 2);
  expect(tableau({{"0", "0"}, {"1/2", "1/2"}}, {"1/2", "1/2"}, {"0", "1"}), 2, 0);
  expect(tableau({{"1/8", "0"}, {"1/4", "3/8"}}, {"1/4", "3/4"}, {"1/8", "5/8"}), 0, 2);
  expect(tableau({{"5/12", "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"}), 0, 0);
  // To ten digits, as above.
  expect(tableau({{"1/2+1e-12"}}, {"1"}, {"1/2"}), 2, 2);
  expect(tableau({{"1/2+1e-8"}}, {"1"}, {"1/2"}), 0, 0);
}

TEST(TableauClaims, AreOfTheTableauAndDifferent) {
  const auto t = tableau({{"1/2"}}, {"1"}, {"1/2"});
  std::set<std::string> keys, problems;
  for (const Claim& claim : tableau_claims(t)) {
    ASSERT_TRUE(as_tableau(*claim.method));
    EXPECT_EQ(as_tableau(*claim.method)->tableau().b.front().text(), t.b.front().text());
    EXPECT_TRUE(keys.insert(key_of(claim)).second) << key_of(claim);
    problems.insert(claim.problem);
  }
  EXPECT_EQ(problems, (std::set<std::string>{"tableau", "kepler", "quartic_oscillator"}));
}

TEST(ClaimKeys, TellAllButTheLabelApart) {
  const Claim base = paper_claims(Extent::quick).front();
  const auto expect = [&](bool same, const char* what, const auto& change) {
    Claim other = base;
    change(other);
    EXPECT_EQ(key_of(other) == key_of(base), same) << what;
  };
  expect(true, "label", [](Claim& c) { c.label = "another"; });
  expect(false, "quantity", [](Claim& c) { c.quantity = Quantity::W; });
  expect(false, "problem", [](Claim& c) { c.problem += "x"; });
  expect(false, "k", [](Claim& c) { c.method = hbvm_of({k_of(c) + 1, s_of(c)}); });
  expect(false, "span", [](Claim& c) { c.span = c.span == Span::step ? Span::interval : Span::step; });
  expect(false, "form", [](Claim& c) { c.form = Form::near; });
  expect(false, "predicted", [](Claim& c) { c.predicted += 1; });
  expect(false, "tolerance", [](Claim& c) { c.tolerance += 1; });
  expect(false, "tableau",
         [](Claim& c) { c.method = std::make_shared<const TableauMethod>(tableau({{"1/2"}}, {"1"}, {"1/2"}), ""); });
  const auto perturbed = [](bool hat, int i, int j, const char* relative) {
    return [=](Claim& c) {
      c.method = hbvm_of({4, 3}, Perturbation{Perturbation::Part::integral, hat, i, j, Expression::parse(relative)});
    };
  };
  std::set<std::string> keys{key_of(base)};
  for (const auto& change : {perturbed(false, 0, 0, "1"), perturbed(true, 0, 0, "1"), perturbed(false, 1, 0, "1"),
                             perturbed(false, 0, 1, "1"), perturbed(false, 0, 0, "2")}) {
    Claim other = base;
    change(other);
    EXPECT_TRUE(keys.insert(key_of(other)).second) << key_of(other);
  }
}

/// Two tableaux may have one name, and the same numbers in another place.
TEST(ClaimKeys, TellTableauxApart) {
  const auto key = [](const Tableau& t) { return key_of(tableau_claims(t).front()); };
  EXPECT_NE(key(tableau({{"1/2"}}, {"1"}, {"1/2"}, 2)), key(tableau({{"1/2+1e-30"}}, {"1"}, {"1/2"}, 2)));
  EXPECT_NE(key(tableau({{"1/2"}}, {"1"}, {"1/2"}, 2)), key(tableau({{"1/2"}}, {"1"}, {"1/3"}, 2)));
}

}  // namespace
}  // namespace hbvm
