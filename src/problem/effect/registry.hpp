#pragma once

#include <tuple>

#include "problem/effect/central_gravity.hpp"
#include "problem/effect/coulomb.hpp"
#include "problem/effect/lennard_jones.hpp"
#include "problem/effect/mutual_gravity.hpp"
#include "problem/effect/oblateness.hpp"
#include "problem/effect/radial_cosine.hpp"
#include "problem/effect/spring.hpp"
#include "problem/effect/trap.hpp"
#include "problem/effect/uniform_gravity.hpp"

namespace hbvm::core {

/// Every effect a scene can name. A new one is its file, and one line here.
using Effects = std::tuple<UniformGravity,  //
                           CentralGravity,  //
                           MutualGravity,   //
                           Coulomb,         //
                           Spring,          //
                           Trap,            //
                           LennardJones,    //
                           RadialCosine,    //
                           Oblateness>;

/// Calls `f.operator()<Effect>()` for the effect of that kind; false if there is none.
template <class F>
bool with_effect(std::string_view kind, F&& f) {
  return [&]<class... E>(std::tuple<E...>*) {
    return ((kind == E::kind && (f.template operator()<E>(), true)) || ...);
  }(static_cast<Effects*>(nullptr));
}

}  // namespace hbvm::core
