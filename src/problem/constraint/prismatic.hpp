#pragma once

#include <array>

#include "problem/constraint/body_joint.hpp"

namespace hbvm::core {

/// A slider on a rail: the point of the second rigid body moves along an axis of the first, and neither turns against
/// the other.
template <Scalar S>
struct Prismatic {
  static constexpr std::string_view kind = "prismatic";
  static constexpr std::array<ConstraintKey, 2> keys{
      {{"between", ConstraintKey::Takes::pair}, {"axis", ConstraintKey::Takes::vector}}};

  static typename BodyJoint<S>::Parts from(const ConstraintInput<S>& input) {
    BodyJoint<S> joint(input);
    joint.slides_along(joint.first(), unit_axis(input.vector("axis"), "axis")).holds_the_orientation();
    return std::move(joint).parts();
  }
};

}  // namespace hbvm::core
