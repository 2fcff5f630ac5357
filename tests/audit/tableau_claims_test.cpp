#include <set>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "method/tableaux.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

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

}  // namespace
}  // namespace hbvm::core
