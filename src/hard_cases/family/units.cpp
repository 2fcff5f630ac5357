#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_units(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "SI units", collection);
  const std::vector<std::string> all{"double", "quad", "mpfr:50"};
  for (const std::string solver : {"auto", "newton", "paper"}) {
    family.add_run("Earth, Moon, satellite", "", all, holds(), earth_moon_satellite,
                   {"hbvm:12,4", solver, "200", family.full() ? "40000" : "10000"});
    family.add_run("two argon atoms", "", all, holds(), argon_pair,
                   {"hbvm:8,3", solver, "1e-14", family.full() ? "4e-12" : "1e-12"});
  }
}

}  // namespace hbvm::core
