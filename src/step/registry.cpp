#include "step/registry.hpp"

#include <algorithm>
#include <array>

#include "method/method_spec.hpp"
#include "nearest.hpp"
#include "step/composition.hpp"
#include "step/energy_momentum.hpp"
#include "step/hbvm_method.hpp"
#include "step/lobatto.hpp"
#include "step/odeint_methods.hpp"
#include "step/projected_stepper.hpp"
#include "step/rattle.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {

namespace {

std::vector<MethodFamily>& all_families() {
  static std::vector<MethodFamily> families{
      {"hbvm",
       "hbvm:K,S with whole numbers K >= S >= 1, e.g. hbvm:5,3, or hbvm:auto,S; hbvm:K,S,R with R nodes for "
       "constraints that are not quadratic",
       hbvm_method},
      {"projected_hbvm", "projected_hbvm:K,S", projected_hbvm_method},
      {"restored_hbvm", "restored_hbvm:K,S", restored_hbvm_method},
      {"energy_momentum", "energy_momentum", energy_momentum_method},
      {"rattle", "rattle", rattle_method},
      {"lobatto", "lobatto:S with S >= 2, e.g. lobatto:3", lobatto_method},
      {"compose", "compose:rattle,P with an even order P", composition_method},
      {"rkf78", "rkf78", rkf78_method},
      {"bulirsch_stoer", "bulirsch_stoer:DIGITS, e.g. bulirsch_stoer:12", bulirsch_stoer_method},
      {"tableau", "tableau:FILE, or tableau:FILE+project", tableau_method},
  };
  return families;
}

/// Methods that are here under another name.
struct Synonym {
  std::string_view name, meant;
};
constexpr std::array synonyms{
    Synonym{"verlet", "rattle, which is Verlet where there are no constraints"},
    Synonym{"velocity_verlet", "rattle, which is Verlet where there are no constraints"},
    Synonym{"stormer_verlet", "rattle, which is Verlet where there are no constraints"},
    Synonym{"leapfrog", "rattle, which is the leapfrog where there are no constraints"},
    Synonym{"shake", "rattle, which has the positions of SHAKE"},
    Synonym{"gauss", "hbvm:S,S, which is Gauss with S stages where there are no constraints"},
    Synonym{"midpoint", "hbvm:1,1, which is the implicit midpoint rule where there are no constraints"},
    Synonym{"yoshida", "compose:rattle,4"},
    Synonym{"euler", "tableau:FILE, which takes any Runge-Kutta method"},
    Synonym{"rk4", "tableau:FILE, which takes any Runge-Kutta method"},
    Synonym{"rk45", "rkf78, or tableau:FILE, which takes any Runge-Kutta method"},
    Synonym{"dopri5", "rkf78, or tableau:FILE, which takes any Runge-Kutta method"},
    Synonym{"radau", "tableau:FILE, which takes any Runge-Kutta method"},
};

}  // namespace

const std::vector<MethodFamily>& method_families() { return all_families(); }

void add_method_family(const MethodFamily& family) {
  for (const MethodFamily& known : method_families())
    if (known.name == family.name) return;
  all_families().push_back(family);
}

MethodPtr parse_method(std::string_view text) {
  const MethodSpec spec = MethodSpec::parse(text);
  for (const MethodFamily& family : method_families())
    if (family.name == spec.family) return family.make(spec.arguments);
  std::vector<std::string> names;
  for (const MethodFamily& family : method_families()) names.emplace_back(family.name);
  const auto synonym =
      std::find_if(synonyms.begin(), synonyms.end(), [&](const Synonym& one) { return one.name == spec.family; });
  const std::string what = "unknown method '" + std::string(text) + "'";
  throw InputError(synonym == synonyms.end() ? what + did_you_mean_or_list(spec.family, names)
                                             : what + ": take " + std::string(synonym->meant));
}

std::string method_usage() {
  std::string text;
  for (const MethodFamily& family : method_families()) text += (text.empty() ? "" : "; ") + std::string(family.usage);
  return text;
}

}  // namespace hbvm::core
