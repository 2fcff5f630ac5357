#include <array>

#include "../family.hpp"

namespace hbvm {

void add_reversal(std::vector<HardCase>& cases, Collection collection) {
  const Family family(cases, "forth and back", collection);
  for (const auto& [scene, method, step, until] : {std::array<std::string, 4>{"kepler", "hbvm:12,4", "1/32", "8"},
                                                   {"double_pendulum", "hbvm:3,3", "1/32", "4"},
                                                   {"heavy_top", "hbvm:3,3", "1/32", "4"},
                                                   {"tethered_satellites", "hbvm:5,3", "1/10", "20"},
                                                   {"fekete_points", "hbvm:6,2", "1/32", "2"}}) {
    if (!family.full() && scene == "fekete_points") continue;
    for (const std::string solver : {"auto", "newton"}) {
      if (!family.full() && solver == "newton" && scene == "tethered_satellites") continue;
      family.add_run(
          scene, "until " + until, std::vector<std::string>{"double", "quad", "mpfr:50"}, holds(),
          [s = scene] { return load_scene(s); }, {method, solver, step, until}, reversal);
    }
  }
}

}  // namespace hbvm
