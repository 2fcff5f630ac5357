#include "audit/audit.hpp"

#include <set>

#include "audit/claims.hpp"
#include "method/tableaux.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

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
  expect(false, "k", [](Claim& c) {
    const HbvmName& name = as_hbvm(*c.method)->name();
    c.method = hbvm_of({name.k + 1, name.s});
  });
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
}  // namespace hbvm::core
