#pragma once

#include <array>

#include "problem/constraint/body_joint.hpp"

namespace hbvm::core {

/// A hinge of two rigid bodies, or of one in space: a common point, and a common direction fixed in both.
template <Scalar S>
struct Hinge {
  static constexpr std::string_view kind = "hinge";
  static constexpr std::array<ConstraintKey, 3> keys{{{"between", ConstraintKey::Takes::pair},
                                                      {"axis", ConstraintKey::Takes::vector},
                                                      {"second_axis", ConstraintKey::Takes::vector, true}}};
  static constexpr std::string_view in_space_only = "in the plane bodies turn about a 'ball_joint'";

  static typename BodyJoint<S>::Parts from(const ConstraintInput<S>& input) {
    const Vector<S> axis = unit_axis(input.vector("axis"), "axis");
    const Vector<S> n = input.has_vector("second_axis") ? unit_axis(input.vector("second_axis"), "second_axis") : axis;
    BodyJoint<S> joint(input);
    joint.holds_the_point().turns_about(axis, n);
    return std::move(joint).parts();
  }
};

}  // namespace hbvm::core
