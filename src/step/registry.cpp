#include "step/registry.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "nearest.hpp"
#include "step/composition.hpp"
#include "step/energy_momentum.hpp"
#include "step/formulation.hpp"
#include "step/hbvm_method.hpp"
#include "step/lobatto.hpp"
#include "step/odeint_methods.hpp"
#include "step/projected_stepper.hpp"
#include "step/radau_method.hpp"
#include "step/rattle.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {

namespace {

MethodPtr known_tableau_method_of(const MethodSpec& spec) { return known_tableau_method(spec.text()); }

/// A method of known_tableaux() without a number.
MethodFamily known(std::string_view name, std::string_view order, std::string_view work, std::string_view note) {
  return {name, name, known_tableau_method_of, name, order, work, note, true};
}

std::vector<MethodFamily>& all_families() {
  static std::vector<MethodFamily> families{
      {"hbvm", "hbvm:K,S", [](const MethodSpec& spec) { return hbvm_method(spec.arguments); }, "hbvm:4,2", "2S",
       "S stages solved, with K forces a sweep",
       "K >= S >= 1; hbvm:auto,S takes as many nodes as H needs, hbvm:K,S,R has R nodes for the constraints"},
      {"projected_hbvm", "projected_hbvm:K,S",
       [](const MethodSpec& spec) { return projected_hbvm_method(spec.arguments); }, "projected_hbvm:4,2", "2S",
       "that of hbvm:K,S and a projection", "ends its steps on both constraints"},
      {"restored_hbvm", "restored_hbvm:K,S",
       [](const MethodSpec& spec) { return restored_hbvm_method(spec.arguments); }, "restored_hbvm:4,2", "2S",
       "that of hbvm:K,S and a projection", "ends its steps on both constraints, with the energy they began with"},
      {"energy_momentum", "energy_momentum", [](const MethodSpec&) { return energy_momentum_method(); },
       "energy_momentum", "2", "1 stage solved, with a discrete gradient a sweep", "of Gonzalez"},
      {"rattle", "rattle", [](const MethodSpec&) { return rattle_method(); }, "rattle", "2", "1 force",
       "symplectic; without constraints it is Verlet, the leapfrog"},
      {"symplectic_euler", "symplectic_euler", [](const MethodSpec&) { return symplectic_euler_method(); },
       "symplectic_euler", "1", "1 force", "symplectic; RATTLE with one whole kick"},
      {"lobatto", "lobatto:S", [](const MethodSpec& spec) { return lobatto_method(spec.arguments); }, "lobatto:3",
       "2S-2", "S stages solved, with S forces a sweep", "S >= 2; Lobatto IIIA-IIIB, symplectic"},
      {"compose", "compose:rattle,P", [](const MethodSpec& spec) { return composition_method(spec.arguments); },
       "compose:rattle,4", "P", "5^(P/2-1) steps of RATTLE", "P even, by Suzuki; symplectic"},
      known("euler", "1", "1 force", "explicit"),
      known("heun", "2", "2 forces", "explicit"),
      known("rk4", "4", "4 forces", "explicit; the classical method of Runge and Kutta"),
      known("dopri5", "5", "6 forces", "explicit; of Dormand and Prince"),
      {"rkf78", "rkf78", [](const MethodSpec&) { return rkf78_method(); }, "rkf78", "8", "13 forces",
       "explicit; of Fehlberg"},
      {"sdirk", "sdirk:S", known_tableau_method_of, "sdirk:3", "2, 3, 4", "S stages solved one by one",
       "S = 2, 3, 5; L-stable", true},
      {"radau", "radau:S", [](const MethodSpec& spec) { return radau_method(spec.arguments); }, "radau:3", "2S-1",
       "S stages solved, with S forces a sweep", "Radau IIA, L-stable", true},
      {"bulirsch_stoer", "bulirsch_stoer:DIGITS",
       [](const MethodSpec& spec) { return bulirsch_stoer_method(spec.arguments); }, "bulirsch_stoer:12", "up to 16",
       "as many forces as the digits take", "explicit; divides its steps"},
      {"tableau", "tableau:FILE", [](const MethodSpec& spec) { return tableau_method(spec.arguments); }, "",
       "that of the file", "that of its stages", "any Runge-Kutta method from a TOML file", true},
  };
  return families;
}

/// The digits of an argument for each S of what is meant.
std::string with_stages(std::string_view meant, const std::string& stages) {
  std::string text;
  for (const char c : meant) text += c == 'S' ? stages : std::string(1, c);
  return text;
}

const MethodFamily* family_named(std::string_view name) {
  for (const MethodFamily& family : method_families())
    if (family.name == name) return &family;
  return nullptr;
}

const MethodAlias* alias_named(std::string_view name) {
  for (const MethodAlias& alias : method_aliases())
    if (alias.name() == name) return &alias;
  return nullptr;
}

MethodPtr method_of(const MethodFamily& family, const MethodSpec& spec) {
  if (family.form == family.name && !spec.arguments.empty()) {
    if (!family.formulated || !FormulatedName::parse(spec.arguments).name.empty())
      throw InputError("method " + spec.family + " takes no arguments" +
                       (family.formulated ? " but " + std::string(formulations) : "") + ", and has '" + spec.arguments +
                       "'");
  }
  return family.make(spec);
}

MethodPtr method_of(const MethodAlias& alias, const MethodSpec& spec) {
  const bool wants_number = alias.form != alias.name();
  if (wants_number ? !whole_number(spec.arguments) : !spec.arguments.empty())
    throw InputError("method " + spec.text() + ": use " + std::string(alias.form) + ", which is " +
                     std::string(alias.meant));
  return parse_method(with_stages(alias.meant, spec.arguments));
}

}  // namespace

const std::vector<MethodFamily>& method_families() { return all_families(); }

const std::vector<MethodAlias>& method_aliases() {
  static const std::vector<MethodAlias> aliases{
      {"verlet", "rattle", "which is Verlet where there are no constraints"},
      {"velocity_verlet", "rattle", "which is Verlet where there are no constraints"},
      {"stormer_verlet", "rattle", "which is Verlet where there are no constraints"},
      {"leapfrog", "rattle", "which is the leapfrog where there are no constraints"},
      {"shake", "rattle", "which has the positions of SHAKE"},
      {"yoshida", "compose:rattle,4", "a composition of order 4, though by five steps, not three"},
      {"gauss:S", "hbvm:S,S", "which is Gauss where there are no constraints"},
      {"midpoint", "hbvm:1,1", "which is the implicit midpoint rule where there are no constraints"},
      {"implicit_euler", "radau:1", "which is the implicit Euler method"},
      {"rk45", "dopri5", "at fixed steps"},
  };
  return aliases;
}

void add_method_family(const MethodFamily& family) {
  if (!family_named(family.name)) all_families().push_back(family);
}

bool is_method_name(std::string_view name) { return family_named(name) || alias_named(name); }

MethodPtr parse_method(std::string_view text) {
  const MethodSpec spec = MethodSpec::parse(text);
  if (const MethodFamily* const family = family_named(spec.family)) return method_of(*family, spec);
  if (const MethodAlias* const alias = alias_named(spec.family)) return method_of(*alias, spec);
  std::vector<std::string> families, names;
  for (const MethodFamily& family : method_families()) families.emplace_back(family.name);
  names = families;
  for (const MethodAlias& alias : method_aliases()) names.emplace_back(alias.name());
  const std::string near = did_you_mean(spec.family, names);
  throw InputError("unknown method '" + std::string(text) + "'" +
                   (near.empty() ? did_you_mean_or_list(spec.family, families) : near));
}

std::vector<NamedMethod> named_methods(const std::vector<std::string>& names) {
  std::vector<NamedMethod> methods;
  for (const std::string& name : names) methods.push_back({name, parse_method(name)});
  return methods;
}

std::string method_usage() {
  return "as hbvm:4,2, hbvm:auto,3, rattle, rk4, gauss:3, radau:3 or tableau:FILE; 'hbvm methods' lists all";
}

}  // namespace hbvm::core
