#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_separatrix(const Family& family) {
  for (const std::string e : {"1e-4", "1e-8", "1e-16", "1e-24", "1e-30"})
    for (const std::string solver : {"auto", "newton", "fixed-point"}) {
      if (!family.full() && (e == "1e-4" || e == "1e-24")) continue;
      family.add_run("pendulum near upright", "angle " + e, all_precisions, holds(), [e] { return near_upright(e); },
                     {"hbvm:8,8", solver, "1/4", "8"});
    }
}

}  // namespace hbvm::core
