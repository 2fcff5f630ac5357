#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_separatrix(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "separatrix", collection);
  for (const std::string e : {"1e-4", "1e-8", "1e-16", "1e-24", "1e-30"})
    for (const std::string solver : {"auto", "newton", "fixed-point"}) {
      if (!family.full() && (e == "1e-4" || e == "1e-24")) continue;
      family.add_run("pendulum near upright", "angle " + e, {"double", "quad", "mpfr:50"}, holds(),
                     [e] { return near_upright(e); }, {"hbvm:8,8", solver, "1/4", "8"});
    }
}

}  // namespace hbvm::core
