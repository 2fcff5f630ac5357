#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "audit/measurements.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using Part = Perturbation::Part;

Claim subject(HbvmName method) {
  Claim claim = make_claim("test", Quantity::B, "tableau", Span::interval, Form::round_off, 0);
  claim.method = hbvm_of(method);
  return claim;
}

std::map<Quantity, double> in_units(std::map<Quantity, double> defects) {
  for (auto& [quantity, defect] : defects) defect = std::exp2(defect) / std::numeric_limits<double>::epsilon();
  return defects;
}

std::map<Quantity, double> defects(HbvmName method, Part part, bool hat, int i, int j = 0) {
  Claim claim = subject(method);
  claim.method = hbvm_of(method, Perturbation{part, hat, i, j, Expression::parse("1e-9")});
  return in_units(tableau_defects<double>(claim));
}

const std::vector<Quantity> conditions{Quantity::B, Quantity::C,        Quantity::D,
                                       Quantity::X, Quantity::symmetry, Quantity::W};

TEST(TableauDefects, AreRoundOffForEveryMethod) {
  for (const HbvmName method : {HbvmName{1, 1}, {3, 1}, {2, 2}, {5, 2}, {4, 4}, {7, 4}})
    for (const auto& [quantity, units] : in_units(tableau_defects<double>(subject(method))))
      EXPECT_LE(units, 2 * method.k) << name_of(quantity) << " of " << method.text();
}

/// Each condition is tried on both sets of nodes. With k > s, a flaw in one set leaves the other as it is. Each of the
/// conditions that hold such a number sees it.
TEST(TableauDefects, EveryConditionSeesAFlawInEitherSetOfNodes) {
  const HbvmName method{4, 3};
  for (const bool hat : {false, true}) {
    for (const Part part : {Part::weight, Part::node}) {
      const auto found = defects(method, part, hat, 0);
      for (const Quantity quantity : conditions) {
        if (quantity == Quantity::W && hat) continue;  // a condition on X_s, of the s nodes alone
        EXPECT_GT(found.at(quantity), 1'000)
            << name_of(quantity) << (hat ? ", k nodes" : ", s nodes") << (part == Part::node ? ", c" : ", b");
      }
      if (hat) {
        EXPECT_LE(found.at(Quantity::W), 2 * method.k);
      }
    }
  }
}

}  // namespace
}  // namespace hbvm::core
