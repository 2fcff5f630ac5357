#pragma once

#include <array>

#include "problem/constraint/body_joint.hpp"

namespace hbvm::core {

/// Two rigid bodies that move as one, or one that stands still: a common point, and no turning.
template <Scalar S>
struct Weld {
  static constexpr std::string_view kind = "weld";
  static constexpr std::array<ConstraintKey, 1> keys{{{"between", ConstraintKey::Takes::pair}}};

  static typename BodyJoint<S>::Parts from(const ConstraintInput<S>& input) {
    BodyJoint<S> joint(input);
    joint.holds_the_point().holds_the_orientation();
    return std::move(joint).parts();
  }
};

}  // namespace hbvm::core
