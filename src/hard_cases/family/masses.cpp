#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_masses(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "mass ratios and lengths", collection);
  const std::vector<std::string> all{"double", "quad", "mpfr:50"};
  const std::string diverges = "stage_equations_diverge";
  for (const std::string m : {"1e-6", "1e-12", "1e-20"})
    for (const std::string solver : {"auto", "newton", "fixed-point"}) {
      if (!family.full() && m != "1e-20") continue;
      family.add_run("light end", "mass " + m, all, holds(), [m] { return double_pendulum("1", m); },
                     {"hbvm:6,3", solver, "1/64", "8"});
    }
  // The light body between pivot and heavy end oscillates with the root of the ratio, which no step follows.
  for (const std::string m : {"1e6", "1e12", "1e20"}) {
    if (!family.full() && m != "1e6") continue;
    family.add_run("heavy end", "mass " + m, all, holds_or({diverges}), [m] { return double_pendulum("1", m); },
                   {"hbvm:6,3", "auto", "1/64", "2"});
  }
  // Short rods make fast pendula: these are followed by steps that shrink with them.
  for (const auto& [length, step, until] : {std::array<std::string, 3>{"1e-6", "1/65536", "1/256"},
                                            {"1e-3", "1/1024", "1/8"},
                                            {"1e3", "1/64", "2"},
                                            {"1e6", "1/1024", "1/8"}}) {
    if (!family.full() && (length == "1e-3" || length == "1e3")) continue;
    family.add_run("second rod", "length " + length, all, holds(),
                   [l = length] { return double_pendulum("1", "1", l); }, {"hbvm:6,3", "auto", step, until});
  }
}

}  // namespace hbvm::core
