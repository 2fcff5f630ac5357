#pragma once

#include <array>

#include "problem/constraint/body_joint.hpp"

namespace hbvm::core {

/// A sleeve on a shaft: a direction fixed in both rigid bodies, along which they slide and about which they turn. The
/// point of the first is on the axis of the second.
template <Scalar S>
struct Cylindrical {
  static constexpr std::string_view kind = "cylindrical";
  static constexpr std::array<ConstraintKey, 3> keys{{{"between", ConstraintKey::Takes::pair},
                                                      {"axis", ConstraintKey::Takes::vector},
                                                      {"second_axis", ConstraintKey::Takes::vector, true}}};
  static constexpr std::string_view in_space_only = "in the plane a pin in a slot is an 'angle' of value 0";

  static typename BodyJoint<S>::Parts from(const ConstraintInput<S>& input) {
    const Vector<S> axis = unit_axis(input.vector("axis"), "axis");
    const Vector<S> n = input.has_vector("second_axis") ? unit_axis(input.vector("second_axis"), "second_axis") : axis;
    BodyJoint<S> joint(input);
    joint.slides_along(joint.second(), n).turns_about(axis, n);
    return std::move(joint).parts();
  }
};

}  // namespace hbvm::core
