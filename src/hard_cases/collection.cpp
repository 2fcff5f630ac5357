#include "hard_cases/collection.hpp"

#include "family.hpp"

namespace hbvm::core {

std::vector<HardCase> hard_cases(Collection collection) {
  const std::pair<const char*, void (*)(const Family&)> families[] = {
      {"nodes and tableaux", add_coefficients},
      {"near-singular and redundant constraints", add_constraints},
      {"mass ratios and lengths", add_masses},
      {"scaling by powers of two", add_scaling},
      {"uncoupled systems of unequal scales", add_uncoupled},
      {"SI units", add_units},
      {"encounters", add_encounters},
      {"separatrix", add_separatrix},
      {"growing steps", add_steps},
      {"stiff springs", add_stiffness},
      {"long runs", add_long_runs},
      {"hidden constraint by parity of s", add_hidden},
      {"chain released from horizontal", add_chain},
      {"many digits and stages", add_digits},
      {"there and back", add_reversal},
      {"charges on a sphere", add_beads},
      {"momenta under weak forces", add_momenta}};
  std::vector<HardCase> cases;
  for (const auto& [name, add] : families) add(Family(cases, name, collection));
  return cases;
}

}  // namespace hbvm::core
