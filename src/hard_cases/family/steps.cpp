#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_steps(const Family& family) {
  const Expected either = holds_or({"stage_equations_diverge"});
  for (int i = -4; i <= 3; ++i) {
    if (!family.full() && i % 2 != 0) continue;
    const std::string step = fmt::format("2^({})", i), until = fmt::format("32*2^({})", i);
    for (const std::string solver : {"auto", "newton", "fixed-point", "paper"}) {
      if (!family.full() && solver != "auto" && solver != "newton") continue;
      family.add_run("Kepler, e = 1/2", "", all_precisions, i <= -4 ? holds() : either, [] { return kepler("1/2"); },
                     {"hbvm:6,3", solver, step, until});
      family.add_run("double pendulum", "", all_precisions, i <= -4 ? holds() : either,
                     [] { return double_pendulum("2", "1", "13/10"); }, {"hbvm:3,3", solver, step, until});
    }
  }
}

}  // namespace hbvm::core
