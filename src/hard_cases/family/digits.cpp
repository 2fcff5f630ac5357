#include "hard_cases/family.hpp"

namespace hbvm::core {

void add_digits(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "many digits and stages", collection);
  for (const std::string scene : {"kepler", "double_pendulum"}) {
    const auto load = [scene] { return load_scene(scene); };
    family.add_run(scene, "", {"mpfr:200"}, holds(), load, {"hbvm:20,12", "auto", "1/4", "1/2"});
    if (family.full())
      family.add_run(scene, "", {"mpfr:500"}, holds(), load, {"hbvm:60,40", "auto", "1/2", "2"}, accuracy, 1800);
  }
}

}  // namespace hbvm::core
