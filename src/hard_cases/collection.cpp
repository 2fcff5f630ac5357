#include "hard_cases/collection.hpp"

#include "family.hpp"

namespace hbvm::core {

std::vector<HardCase> hard_cases(Collection collection) {
  std::vector<HardCase> cases;
  for (const auto add : {add_coefficients, add_constraints, add_masses, add_scaling, add_uncoupled, add_units,
                         add_encounters, add_separatrix, add_steps, add_stiffness, add_long_runs, add_hidden, add_chain,
                         add_digits, add_reversal, add_beads, add_momenta})
    add(cases, collection);
  return cases;
}

}  // namespace hbvm::core
