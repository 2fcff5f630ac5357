#pragma once

#include <array>

#include "problem/constraint/body_joint.hpp"

namespace hbvm::core {

/// Cardan's joint, a cross in two forks: a common point, and an axis of each rigid body across that of the other.
template <Scalar S>
struct Universal {
  static constexpr std::string_view kind = "universal";
  static constexpr std::array<ConstraintKey, 3> keys{{{"between", ConstraintKey::Takes::pair},
                                                      {"axis", ConstraintKey::Takes::vector},
                                                      {"second_axis", ConstraintKey::Takes::vector}}};
  static constexpr std::string_view in_space_only = "in the plane all axes are parallel";

  static typename BodyJoint<S>::Parts from(const ConstraintInput<S>& input) {
    const Vector<S> n = unit_axis(input.vector("axis"), "axis"),
                    m = unit_axis(input.vector("second_axis"), "second_axis");
    BodyJoint<S> joint(input);
    joint.holds_the_point().crosses(n, m);
    const Vector<S> a = BodyJoint<S>::orthonormal(joint.first()).transpose() * n,
                    b = BodyJoint<S>::orthonormal(joint.second()).transpose() * m;
    if (max_norm(Vector<S>(a.template head<3>().cross(b.template head<3>()))) <= S(64) * epsilon<S>())
      throw InputError("its axes are parallel at the start; each stands across the other");
    return std::move(joint).parts();
  }
};

}  // namespace hbvm::core
