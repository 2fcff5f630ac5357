#include <array>

#include "hard_cases/family.hpp"

namespace hbvm::core {

void add_reversal(const Family& family) {
  std::vector<std::array<std::string, 4>> runs{{"kepler", "hbvm:12,4", "1/32", "2"},
                                               {"double_pendulum", "hbvm:3,3", "1/32", "1"},
                                               {"heavy_top", "hbvm:3,3", "1/32", "1"},
                                               {"tethered_satellites", "hbvm:5,3", "1/10", "4"}};
  if (family.full())
    runs = {{"kepler", "hbvm:12,4", "1/32", "8"},
            {"double_pendulum", "hbvm:3,3", "1/32", "4"},
            {"heavy_top", "hbvm:3,3", "1/32", "4"},
            {"tethered_satellites", "hbvm:5,3", "1/10", "20"},
            {"fekete_points", "hbvm:6,2", "1/32", "2"}};
  for (const auto& [scene, method, step, until] : runs)
    for (const std::string solver : {"auto", "newton"})
      family.add_run(
          scene, "until " + until, all_precisions, holds(), [s = scene] { return load_scene(s); },
          {method, solver, step, until}, reversal);
}

}  // namespace hbvm::core
