#pragma once

#include "scalar/scalar.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// The digits that the start of a scene is written with, if its numbers were rounded to 15 or more, as in double. It is
/// the most that a decimal of a position, velocity, momentum, director or angular velocity has. Else 0: few digits are
/// meant as they stand.
int own_digits(const Scene& scene);

/// The relative rounding of the start of a scene in S: that of its own digits, if it is coarser than that of S.
template <Scalar S>
S own_precision(const Scene& scene);

}  // namespace hbvm::core
