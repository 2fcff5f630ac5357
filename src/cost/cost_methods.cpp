#include "cost/cost_methods.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "nearest.hpp"
#include "step/hbvm_method.hpp"
#include "step/registry.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

using Methods = std::vector<MethodPtr>;

/// Numbers of stages up to what so many digits ask for: nine for twenty digits is best where there are many.
std::vector<int> stages_for(double digits, Choice choice) {
  const int best = static_cast<int>(std::lround(9 * digits / 20));
  std::vector<int> result;
  const auto add = [&](std::initializer_list<int> stages) {
    for (const int s : stages)
      if (s <= std::min(max_s, 8 + best)) result.push_back(s);
  };
  add({1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192});
  if (choice == Choice::dense) add({5, 7, 10, 14, 20, 28, 40, 56, 80, 112, 160});
  std::sort(result.begin(), result.end());
  return result;
}

struct Family {
  std::string name;
  std::function<Methods(double digits, Choice choice)> members;
};

Methods parsed(const std::vector<std::string>& names) {
  Methods methods;
  for (const std::string& name : names) methods.push_back(parse_method(name));
  return methods;
}

/// HBVM(s,s) that ends its steps otherwise.
Methods of_stages(const std::string& family, double digits) {
  Methods methods;
  for (const int s : {2, 4, 8, 16, 32})
    if (s <= 8 + digits / 2)
      methods.push_back(parse_method(family + ":" + std::to_string(s) + "," + std::to_string(s)));
  return methods;
}

/// Whether a family that is not listed is a method worth a try unasked. First order never pays, and a tableau costs
/// what one of the listed families costs at best.
bool is_tried_unasked(const MethodFamily& family) {
  if (family.form != family.name) return false;
  const MethodPtr method = parse_method(family.name);
  return method->order() > 1 && !as_tableau(*method);
}

std::vector<Family> families() {
  std::vector<Family> result{
      {"gauss",
       [](double digits, Choice choice) {
         Methods methods;
         for (const int s : stages_for(digits, choice)) methods.push_back(hbvm_of({s, s}));
         return methods;
       }},
      {"auto",
       [](double digits, Choice) {
         // More nodes than stages cost much where stages are many.
         Methods methods;
         for (const int s : {1, 2, 3, 4, 8, 16})
           if (s <= 8 + digits / 2) methods.push_back(hbvm_of({0, s}));
         return methods;
       }},
      {"rattle", [](double, Choice) { return parsed({"rattle"}); }},
      {"compose",
       [](double, Choice) {
         return parsed({"compose:rattle,4", "compose:rattle,6", "compose:rattle,8"});
       }},
      {"lobatto",
       [](double, Choice) {
         return parsed({"lobatto:3", "lobatto:4", "lobatto:6"});
       }},
      // What projection takes is more than further nodes would save: as many as stages.
      {"projected_hbvm", [](double digits, Choice) { return of_stages("projected_hbvm", digits); }},
      {"restored_hbvm", [](double digits, Choice) { return of_stages("restored_hbvm", digits); }},
      {"bulirsch_stoer",
       [](double digits, Choice choice) {
         // Of order 16 at most, it takes too many steps for more.
         const int most = choice == Choice::dense ? 20 : 30;
         Methods methods;
         for (const int asked : {4, 7, 10, 13, 16, 20, 25, 30})
           if (asked <= std::min<double>(digits + 10, most))
             methods.push_back(parse_method("bulirsch_stoer:" + std::to_string(asked)));
         return methods;
       }},
  };
  for (const MethodFamily& family : method_families()) {
    const auto known = [&](const Family& f) { return f.name == family.name; };
    if (std::any_of(result.begin(), result.end(), known)) continue;
    if (!is_tried_unasked(family)) continue;
    const std::string name(family.name);
    result.push_back({name, [name](double, Choice) { return parsed({name}); }});
  }
  return result;
}

}  // namespace

std::vector<std::string> cost_families() {
  std::vector<std::string> names;
  for (const Family& family : families()) names.push_back(family.name);
  return names;
}

std::vector<MethodPtr> cost_methods(const std::vector<std::string>& list, double most_digits, Choice choice) {
  const std::vector<Family> known = families();
  const std::vector<std::string> names = list.empty() ? cost_families() : list;
  Methods methods;
  const auto add = [&](const MethodPtr& method) {
    const auto same = [&](const MethodPtr& other) { return other->key() == method->key(); };
    if (std::none_of(methods.begin(), methods.end(), same)) methods.push_back(method);
  };
  for (const std::string& name : names) {
    const auto family = std::find_if(known.begin(), known.end(), [&](const Family& f) { return f.name == name; });
    if (family == known.end() && !is_method_name(MethodSpec::parse(name).family))
      throw InputError("--methods: '" + name + "' is no family of methods" + did_you_mean(name, cost_families()) +
                       "; write a method as " + method_usage());
    if (family == known.end())
      add(parse_method(name));
    else
      for (const MethodPtr& method : family->members(most_digits, choice)) add(method);
  }
  return methods;
}

bool suits(const Method& method, const Precision& precision) {
  if (!method.digits() || method.kept().energy) return true;
  // With far more digits than are asked for each operation costs more, and nothing is gained.
  const int working = static_cast<int>(precision.digits());
  constexpr int guard = 16;
  return *method.digits() <= working && working <= 2 * *method.digits() + guard;
}

double typical_reach(const Method& method) {
  if (as_hbvm(method)) return 4;
  return method.order() <= 2 ? 3 : 2;
}

}  // namespace hbvm::core
