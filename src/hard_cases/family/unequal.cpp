#include <array>

#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_masses(const Family& family) {
  const std::string diverges = "stage_equations_diverge";
  for (const std::string m : {"1e-6", "1e-12", "1e-20"})
    for (const std::string solver : {"auto", "newton", "fixed-point"}) {
      if (!family.full() && m != "1e-20") continue;
      family.add_run("light end", "mass " + m, all_precisions, holds(), [m] { return double_pendulum("1", m); },
                     {"hbvm:6,3", solver, "1/64", "8"});
    }
  // The light body between pivot and heavy end oscillates with the root of the ratio, which no step follows.
  for (const std::string m : {"1e6", "1e12", "1e20"}) {
    if (!family.full() && m != "1e6") continue;
    family.add_run("heavy end", "mass " + m, all_precisions, holds_or({diverges}),
                   [m] { return double_pendulum("1", m); }, {"hbvm:6,3", "auto", "1/64", "2"});
  }
  // Short rods make fast pendula: these are followed by steps that shrink with them.
  for (const auto& [length, step, until] : {std::array<std::string, 3>{"1e-6", "1/65536", "1/256"},
                                            {"1e-3", "1/1024", "1/8"},
                                            {"1e3", "1/64", "2"},
                                            {"1e6", "1/1024", "1/8"}}) {
    if (!family.full() && (length == "1e-3" || length == "1e3")) continue;
    family.add_run("second rod", "length " + length, all_precisions, holds(),
                   [l = length] { return double_pendulum("1", "1", l); }, {"hbvm:6,3", "auto", step, until});
  }
}

void add_uncoupled(const Family& family) {
  for (const std::string m : {"1e-4", "1e-8", "1e-12", "1e-16"})
    for (const std::string solver : {"auto", "newton", "paper"}) {
      if (!family.full() && (m == "1e-4" || m == "1e-16")) continue;
      family.add_run("orbit beside a heavy body", "mass " + m, all_precisions, holds(),
                     [m] { return beside_kepler(m); }, {"hbvm:6,2", solver, "2*pi/64", "4*pi"});
    }
  for (const std::string m : {"1e-8", "1e-12"}) {
    if (!family.full() && m == "1e-8") continue;
    family.add_run("orbit on a weak spring", "mass " + m, all_precisions, holds(),
                   [m] { return beside_kepler(m, m + "*1e-6"); }, {"hbvm:6,2", "auto", "2*pi/64", "4*pi"});
  }
}

void add_units(const Family& family) {
  for (const std::string solver : {"auto", "newton", "paper"}) {
    family.add_run("Earth, Moon, satellite", "", all_precisions, holds(), earth_moon_satellite,
                   {"hbvm:12,4", solver, "200", family.full() ? "40000" : "10000"});
    family.add_run("two argon atoms", "", all_precisions, holds(), argon_pair,
                   {"hbvm:8,3", solver, "1e-14", family.full() ? "4e-12" : "1e-12"});
  }
}

}  // namespace hbvm::core
