#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "hard_cases/round_off_growth.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_chain(const Family& family) {
  const Expected either = holds_or({"stage_equations_diverge", "near_singular_constraints"});
  for (const int rods : {20, 100}) {
    const bool all = family.full() || rods < 100;
    family.add_run("whip", fmt::format("{} rods", rods), {"double"}, either, [rods] { return whip(rods); },
                   {"hbvm:4,2", "auto", "1/256", all ? "1/2" : "1/16"});
    if (family.full())
      family.add_run(
          "whip", fmt::format("{} rods", rods), {"quad", "mpfr:50"}, either, [rods] { return whip(rods); },
          {"hbvm:4,2", "auto", "1/256", "1/16"}, accuracy, 1200);
  }
}

void add_digits(const Family& family) {
  for (const std::string scene : {"kepler", "double_pendulum"}) {
    const auto load = [scene] { return load_scene(scene); };
    family.add_run(scene, "", {"mpfr:200"}, holds(), load, {"hbvm:20,12", "auto", "1/4", "1/2"});
    if (family.full())
      family.add_run(scene, "", {"mpfr:500"}, holds(), load, {"hbvm:60,40", "auto", "1/2", "2"}, accuracy, 1800);
  }
}

void add_beads(const Family& family) {
  const auto scene = [] { return beads_on_sphere(20); };
  family.add_run("20 beads", "", family.precisions(), holds(), scene,
                 {"hbvm:12,2", "auto", "1/32", family.full() ? "1" : "1/4"});
  if (family.full())
    family.add_run("20 beads", "until 1000", {"double"}, holds(), scene, {"hbvm:12,2", "auto", "1/32", "1000"},
                   long_run, 3600);
}

}  // namespace hbvm::core
