#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_uncoupled(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "uncoupled systems of unequal scales", collection);
  const std::vector<std::string> all{"double", "quad", "mpfr:50"};
  for (const std::string m : {"1e-4", "1e-8", "1e-12", "1e-16"})
    for (const std::string solver : {"auto", "newton", "paper"}) {
      if (!family.full() && (m == "1e-4" || m == "1e-16")) continue;
      family.add_run("orbit beside a heavy body", "mass " + m, all, holds(), [m] { return beside_kepler(m); },
                     {"hbvm:6,2", solver, "2*pi/64", "4*pi"});
    }
  for (const std::string m : {"1e-8", "1e-12"}) {
    if (!family.full() && m == "1e-8") continue;
    family.add_run("orbit on a weak spring", "mass " + m, all, holds(), [m] { return beside_kepler(m, m + "*1e-6"); },
                   {"hbvm:6,2", "auto", "2*pi/64", "4*pi"});
  }
}

}  // namespace hbvm::core
