#pragma once

#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "problem/constraint/common_point.hpp"
#include "problem/constraint/cylindrical.hpp"
#include "problem/constraint/displacement_product.hpp"
#include "problem/constraint/form.hpp"
#include "problem/constraint/formula_constraint.hpp"
#include "problem/constraint/gear.hpp"
#include "problem/constraint/hinge.hpp"
#include "problem/constraint/plane.hpp"
#include "problem/constraint/prismatic.hpp"
#include "problem/constraint/quadric.hpp"
#include "problem/constraint/rod.hpp"
#include "problem/constraint/universal.hpp"
#include "problem/constraint/weld.hpp"

namespace hbvm::core {

/// Every form of constraint: those that a scene can name by their kinds, at most quadratic, and g by any other formula.
/// A new one is its file, and one line here.
template <Scalar S>
using ConstraintForms = std::variant<Rod<S>,      //
                                     Quadric<S>,  //
                                     Plane<S>,    //
                                     DisplacementProduct<S>, CommonPoint<S>, FormulaConstraint<S>>;

/// What a scene can name besides: a kind and keys that stand for several g of those forms. A new one is its file, and
/// its name here.
template <Scalar S>
using ConstraintGroups = std::tuple<Hinge<S>, Weld<S>, Prismatic<S>, Cylindrical<S>, Universal<S>, Gear<S>>;

/// What an evaluator of the gradient of one of them holds.
template <class Forms>
struct GradientsOf;
template <class... F>
struct GradientsOf<std::variant<F...>> {
  using type = std::variant<typename F::Gradient...>;
};

/// Calls `f.operator()<Form>()` for every quadratic form in turn.
template <Scalar S, class F>
void for_each_constraint_form(F&& f) {
  [&]<class... Form>(std::variant<Form...>*) {
    static_assert(((ConstraintForm<Form, S> || std::same_as<Form, FormulaConstraint<S>>)&&...));
    const auto call = [&]<class One>() {
      if constexpr (ConstraintForm<One, S>) f.template operator()<One>();
    };
    (call.template operator()<Form>(), ...);
  }(static_cast<ConstraintForms<S>*>(nullptr));
}

/// Calls `f.operator()<Kind>()` for every form and every group.
template <Scalar S, class F>
void for_each_constraint_kind(F&& f) {
  for_each_constraint_form<S>(f);
  [&]<class... Group>(std::tuple<Group...>*) {
    (f.template operator()<Group>(), ...);
  }(static_cast<ConstraintGroups<S>*>(nullptr));
}

/// Calls `f.operator()<Kind>()` for the form or group of that kind; false if there is none.
template <Scalar S, class F>
bool with_constraint_kind(std::string_view kind, F&& f) {
  bool found = false;
  for_each_constraint_kind<S>([&]<class Kind>() {
    if (kind != Kind::kind) return;
    found = true;
    f.template operator()<Kind>();
  });
  return found;
}

/// The kinds as scenes name them.
inline std::vector<std::string> constraint_kinds() {
  std::vector<std::string> kinds;
  for_each_constraint_kind<double>([&]<class Kind>() { kinds.emplace_back(Kind::kind); });
  return kinds;
}

}  // namespace hbvm::core
