#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"
#include "hard_cases/walk.hpp"

namespace hbvm::core {

void add_beads(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "charges on a sphere", collection);
  const auto scene = [] { return beads_on_sphere(20); };
  family.add_run("20 beads", "", family.precisions(), holds(), scene,
                 {"hbvm:12,2", "auto", "1/32", family.full() ? "1" : "1/4"});
  if (family.full())
    family.add_run("20 beads", "until 1000", {"double"}, holds(), scene, {"hbvm:12,2", "auto", "1/32", "1000"},
                   long_run, 3600);
}

}  // namespace hbvm::core
