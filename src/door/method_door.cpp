#include "door/door.hpp"
#include "door/tableau_of.hpp"
#include "hbvm/method.hpp"
#include "method/read_tableau.hpp"
#include "scalar/precision.hpp"
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

Tableau read_tableau(const std::string& path) {
  const core::Tableau read = core::read_tableau(path);
  Tableau tableau{.name = read.name, .A = {}, .b = {}, .c = {}, .order = read.order, .digits = read.digits};
  const auto to_texts = [](const std::vector<core::Expression>& row) {
    Numbers numbers;
    for (const core::Expression& entry : row) numbers.emplace_back(entry.text());
    return numbers;
  };
  for (const auto& row : read.A) tableau.A.push_back(to_texts(row));
  tableau.b = to_texts(read.b);
  tableau.c = to_texts(read.c);
  return tableau;
}

}  // namespace hbvm

namespace hbvm::core {

Tableau tableau_of(const hbvm::Tableau& door) {
  const std::string name = door.name.empty() ? "tableau" : door.name;
  Tableau tableau{name, {}, {}, {}, door.order, door.digits};
  const auto row = [&](const Numbers& numbers, const std::string& what) {
    std::vector<Expression> entries;
    for (const Number& number : numbers) entries.push_back(expression_of(number, name + ": " + what + ":"));
    return entries;
  };
  for (const Numbers& numbers : door.A) tableau.A.push_back(row(numbers, "A"));
  tableau.b = row(door.b, "b");
  tableau.c = row(door.c, "c");
  if (door.c.empty())
    for (const Numbers& numbers : door.A) {
      std::string sum;
      for (const Number& number : numbers) sum += (sum.empty() ? "(" : "+(") + number.text() + ")";
      tableau.c.push_back(expression_of(sum, name + ": c:"));
    }
  make_runge_kutta<double>(tableau);  // refuses what has other sizes
  return tableau;
}

}  // namespace hbvm::core
