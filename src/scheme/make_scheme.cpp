#include <algorithm>

#include "hbvm/error.hpp"
#include "nearest.hpp"
#include "scheme/families.hpp"

namespace hbvm::core {
namespace {

/// A family, and the arrays that its text may have: those that it must have come first.
struct Family {
  std::string name;
  SchemePtr (*make)(const SchemeText&);
  std::vector<std::string> required, optional;
};

const std::vector<Family>& families() {
  static const std::vector<Family> families{
      {"partitioned", partitioned_scheme, {"A", "b", "A_hat", "b_hat"}, {}},
      {"nystrom", nystrom_scheme, {"c", "A", "b", "b_hat"}, {"A_hat"}},
      {"runge_kutta", runge_kutta_scheme, {"A", "b"}, {"c", "b_hat", "b_theta"}},
      {"rosenbrock", rosenbrock_scheme, {"alpha", "gamma", "b"}, {"b_hat"}},
      {"splitting", splitting_scheme, {"a", "b"}, {}},
      {"composition", composition_scheme, {}, {"gamma", "alpha", "beta"}},
      {"multistep", multistep_scheme, {"alpha", "beta"}, {}},
  };
  return families;
}

bool has_all(const SchemeText& text, const std::vector<std::string>& keys) {
  return std::all_of(keys.begin(), keys.end(), [&](const std::string& key) { return text.arrays.contains(key); });
}

/// The first whose arrays are there. Nystrom methods and pairs of Runge and Kutta have the same ones: a family must be
/// named to be the former.
const Family& family_of(const SchemeText& text) {
  std::vector<std::string> names;
  for (const Family& family : families()) {
    names.push_back(family.name);
    if (text.family == family.name) return family;
  }
  if (!text.family.empty())
    throw InputError(text.file + ": unknown family '" + text.family + "'" + did_you_mean_or_list(text.family, names));
  for (const Family& family : families()) {
    if (family.name == "nystrom") continue;
    const std::vector<std::string>& keys =
        family.name == "composition" ? std::vector<std::string>{"gamma"} : family.required;
    if (has_all(text, keys)) return family;
  }
  throw InputError(text.file + ": no family has just these arrays; a Runge-Kutta method has A and b. Families: " +
                   "runge_kutta, partitioned, nystrom, rosenbrock, splitting, composition, multistep");
}

}  // namespace

SchemePtr make_scheme(const SchemeText& text) {
  const Family& family = family_of(text);
  std::vector<std::string> known = family.required;
  known.insert(known.end(), family.optional.begin(), family.optional.end());
  for (const auto& [key, rows] : text.arrays)
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw InputError(text.file + ": unknown key '" + key + "' of family " + family.name +
                       did_you_mean_or_list(key, known));
  return family.make(text);
}

}  // namespace hbvm::core
