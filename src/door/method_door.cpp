#include "door/door.hpp"
#include "hbvm/method.hpp"
#include "step/registry.hpp"

namespace hbvm {

std::vector<MethodKind> methods() {
  const core::Admitted admitted({});
  std::vector<MethodKind> kinds;
  for (const core::MethodFamily& family : core::method_families())
    kinds.push_back({std::string(family.name), std::string(family.usage)});
  return kinds;
}

MethodFacts method_facts(const std::string& text) {
  const core::Admitted admitted({});
  const core::MethodPtr method = core::parse_method(text);
  const core::Kept kept = method->kept();
  return {.text = method->text(),
          .title = method->title(),
          .order = method->order(),
          .stages = method->stages(),
          .keeps_energy = kept.energy,
          .keeps_momenta = kept.momenta,
          .keeps_constraints = kept.constraints,
          .is_symmetric = kept.reversal};
}

}  // namespace hbvm

namespace hbvm::core {

Tableau completed(Tableau tableau) {
  if (tableau.name.empty()) tableau.name = "tableau";
  const auto check = [&](const Numbers& numbers, const std::string& what) {
    for (const Number& number : numbers) expression_of(number, tableau.name + ": " + what + ":");
  };
  for (const Numbers& row : tableau.A) check(row, "A");
  check(tableau.b, "b");
  if (tableau.c.empty())
    for (const Numbers& row : tableau.A) {
      std::string sum;
      for (const Number& number : row) sum += (sum.empty() ? "(" : "+(") + number.text() + ")";
      tableau.c.emplace_back(sum);
    }
  check(tableau.c, "c");
  make_runge_kutta<double>(tableau);  // refuses what has other sizes
  return tableau;
}

}  // namespace hbvm::core
