#pragma once

#include <tuple>

#include "problem/force/damper.hpp"
#include "problem/force/drag.hpp"
#include "problem/force/formula_force.hpp"
#include "problem/force/magnetic_field.hpp"
#include "problem/force/rotating_frame.hpp"
#include "problem/force/torque.hpp"

namespace hbvm::core {

/// Every force without a potential that a scene can name. A new one is its file, and its name here.
using Forces = std::tuple<Damper, Drag, Torque, MutualTorque, MagneticField, RotatingFrame, FormulaForce>;

/// Calls `f.operator()<Force>()` for the force of that kind, and the one between two bodies if `mutual`, where there
/// are both; false if there is none.
template <class F>
bool with_force(std::string_view kind, bool mutual, F&& f) {
  return [&]<class... One>(std::tuple<One...>*) {
    const auto is = [&]<class Force>(const Force*) {
      const bool both = kind == Torque::kind;
      return kind == Force::kind && (!both || mutual == (Force::on == ForceOn::rigid_bodies));
    };
    return ((is(static_cast<const One*>(nullptr)) && (f.template operator()<One>(), true)) || ...);
  }(static_cast<Forces*>(nullptr));
}

}  // namespace hbvm::core
