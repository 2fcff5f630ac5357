#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_chain(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "chain released from horizontal", collection);
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

}  // namespace hbvm::core
