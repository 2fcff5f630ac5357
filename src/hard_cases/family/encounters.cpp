#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {

void add_encounters(const Family& family) {
  const std::vector<std::string> some = family.precisions();
  const std::string diverges = "stage_equations_diverge";
  // Where no number of nodes will do, the run must say so, or stop.
  const Expected honest{true, {diverges, "refused"}, {"energy_lost"}, {}};
  for (const std::string j : {"1", "2", "3"})
    family.add_run(
        "pendulum past a charge", "distance 10^-" + j, j == "1" ? all_precisions : some, honest,
        [j] { return charge_below("10^(-" + j + ")"); }, {"hbvm:auto,3", "auto", "1/64", "4"}, energy);
  for (const std::string e : {"0.9", "0.99", "0.999"})
    for (const bool pericentre : {true, false}) {
      const std::string start = pericentre ? " from the pericentre" : " from the apocentre";
      family.add_run(
          "Kepler" + start, "e = " + e, some, honest, [e, pericentre] { return kepler(e, pericentre); },
          {"hbvm:auto,3", "auto", "2*pi/1024", "2*pi"}, energy);
      if (!pericentre && e == "0.99")
        family.add_run(
            "Kepler" + start, "e = " + e, {"mpfr:50"}, honest, [e] { return kepler(e, false); },
            {"hbvm:auto,3", "auto", "2*pi/256", "2*pi"}, energy);
      if (e != "0.999")
        family.add_run("Kepler" + start, "e = " + e, some, holds_or({diverges}),
                       [e, pericentre] { return kepler(e, pericentre); }, {"hbvm:20,3", "auto", "2*pi/1024", "2*pi"});
    }
  for (const std::string v : {"1e-1", "1e-3", "1e-6"})
    family.add_run(
        "two bodies nearly collide", "velocity " + v, v == "1e-6" ? all_precisions : some, honest,
        [v] { return near_collision(v); }, {"hbvm:auto,3", "auto", "1/1024", "3"}, energy);
}

}  // namespace hbvm::core
