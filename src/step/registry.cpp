#include "hbvm/step/registry.hpp"

#include "hbvm/method/method_spec.hpp"
#include "hbvm/step/composition.hpp"
#include "hbvm/step/energy_momentum.hpp"
#include "hbvm/step/hbvm_method.hpp"
#include "hbvm/step/lobatto.hpp"
#include "hbvm/step/odeint_methods.hpp"
#include "hbvm/step/projected_stepper.hpp"
#include "hbvm/step/rattle.hpp"
#include "hbvm/step/tableau_method.hpp"

namespace hbvm {

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
  throw InputError("unknown method '" + std::string(text) + "': use " + method_usage());
}

std::string method_usage() {
  std::string text;
  for (const MethodFamily& family : method_families()) text += (text.empty() ? "" : "; ") + std::string(family.usage);
  return text;
}

}  // namespace hbvm
