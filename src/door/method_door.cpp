#include "door/door.hpp"
#include "hbvm/method.hpp"
#include "hbvm/table.hpp"
#include "long_work/json.hpp"
#include "method/runge_kutta.hpp"
#include "step/registry.hpp"

namespace hbvm {
namespace {

std::string kept_by(std::string_view method) {
  if (method.empty()) return {};
  const core::Kept kept = core::parse_method(method)->kept();
  std::string text;
  const auto add = [&](bool is_kept, const char* what) {
    if (is_kept) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(kept.energy, "energy");
  add(kept.momenta, "momenta");
  add(kept.constraints, kept.hidden ? "both constraints" : "constraints");
  add(kept.reversal, "reversal");
  return text;
}

}  // namespace

std::vector<MethodKind> methods() {
  const core::Admitted admitted({});
  std::vector<MethodKind> kinds;
  for (const core::MethodFamily& family : core::method_families())
    kinds.push_back({.name = std::string(family.name),
                     .form = std::string(family.form),
                     .meant = {},
                     .order = std::string(family.order),
                     .keeps = kept_by(family.example),
                     .work = std::string(family.work),
                     .note = std::string(family.note)});
  for (const core::MethodAlias& alias : core::method_aliases())
    kinds.push_back({.name = std::string(alias.name()),
                     .form = std::string(alias.form),
                     .meant = std::string(alias.meant),
                     .order = {},
                     .keeps = {},
                     .work = {},
                     .note = std::string(alias.note)});
  return kinds;
}

std::string to_text(const std::vector<MethodKind>& kinds) {
  Table own, others;
  own.columns = {"method", "order", "keeps", "work of a step", "note"};
  others.columns = {"method", "is", "note"};
  own.groups.push_back({.heading = "Methods", .keys = {}, .rows = {}});
  others.groups.push_back({.heading = "Other names", .keys = {}, .rows = {}});
  for (const MethodKind& kind : kinds)
    if (kind.meant.empty())
      own.groups.front().rows.push_back({kind.form, kind.order, kind.keeps, kind.work, kind.note});
    else
      others.groups.front().rows.push_back({kind.form, kind.meant, kind.note});
  return to_text(own) + to_text(others);
}

std::string to_json(const std::vector<MethodKind>& kinds) {
  core::OrderedJson list = core::OrderedJson::array();
  for (const MethodKind& kind : kinds) {
    core::OrderedJson one{{"name", kind.name}, {"form", kind.form}};
    if (kind.meant.empty())
      one.update({{"order", kind.order}, {"keeps", kind.keeps}, {"work", kind.work}});
    else
      one["is"] = kind.meant;
    one["note"] = kind.note;
    list.push_back(std::move(one));
  }
  return core::dumped({{"methods", list}}, 2);
}

MethodFacts method_facts(const std::string& text) {
  const core::Admitted admitted({});
  const core::MethodPtr method = core::parse_method(text);
  const core::Kept kept = method->kept();
  return {.text = method->text(),
          .title = method->title(),
          .order = method->order(),
          .stages = method->stages(),
          .keeps_energy = kept.energy,
          .keeps_momenta = kept.momenta,
          .keeps_constraints = kept.constraints,
          .is_symmetric = kept.reversal};
}

}  // namespace hbvm

namespace hbvm::core {

Tableau completed(Tableau tableau) {
  if (tableau.name.empty()) tableau.name = "tableau";
  const auto check = [&](const Numbers& numbers, const std::string& what) {
    for (const Number& number : numbers) expression_of(number, tableau.name + ": " + what + ":");
  };
  for (const Numbers& row : tableau.A) check(row, "A");
  check(tableau.b, "b");
  if (tableau.c.empty())
    for (const Numbers& row : tableau.A) {
      std::string sum;
      for (const Number& number : row) sum += (sum.empty() ? "(" : "+(") + number.text() + ")";
      tableau.c.emplace_back(sum);
    }
  check(tableau.c, "c");
  make_runge_kutta<double>(tableau);  // refuses what has other sizes
  return tableau;
}

}  // namespace hbvm::core
