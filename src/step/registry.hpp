#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "method/method_spec.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// One kind of method: how it is written, what makes one, and what is said of it in a list.
struct MethodFamily {
  std::string_view name;                 ///< before the colon
  std::string_view form;                 ///< "hbvm:K,S"; a form without a colon takes no arguments
  MethodPtr (*make)(const MethodSpec&);  ///< \throws InputError for arguments that are none
  std::string_view example = {};         ///< one that can be made; empty if there is none without a file
  std::string_view order = {};           ///< of its members: "2S"
  std::string_view work = {};            ///< what a step costs
  std::string_view note = {};
  bool formulated = false;  ///< whether a formulation may stand behind it, as in "rk4+project"
};

/// All there are.
const std::vector<MethodFamily>& method_families();
/// One more, unless one of its name is there. Its method may need what this folder must not know, as `taylor`, or be of
/// a program of one's own. Before threads are started.
void add_method_family(const MethodFamily& family);

/// A name that is known elsewhere for a method that is here.
struct MethodAlias {
  std::string_view form;   ///< "verlet", or "gauss:S" with a whole number S
  std::string_view meant;  ///< "rattle", "hbvm:S,S"
  std::string_view note = {};

  std::string_view name() const { return form.substr(0, form.find(':')); }
};

const std::vector<MethodAlias>& method_aliases();

/// Whether a family or an alias has this name.
bool is_method_name(std::string_view name);

/// \throws InputError for a family or arguments that do not exist, with what there is
MethodPtr parse_method(std::string_view text);

/// A method beside the name it was asked for by, which may be an alias.
struct NamedMethod {
  std::string name;
  MethodPtr method;
};

/// \throws InputError as parse_method() does
std::vector<NamedMethod> named_methods(const std::vector<std::string>& names);

/// How methods are written, in one line.
std::string method_usage();

}  // namespace hbvm::core
