#pragma once

#include <vector>

#include "linear/matrix.hpp"
#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// How one use of an effect depends on its displacements, one entry (or row) an instance. It is what the effect
/// declares of its formula, so that no weakness of a force can hide it. Of a formula in a scene it is computed.
template <Scalar S>
struct EffectSymmetry {
  Symmetry kind = Symmetry::central;
  std::vector<bool> acts;    ///< false if a factor of U is 0
  Matrix<S> axes;            ///< n, in any length; no rows if the effect is central
  Matrix<S> axis_round_off;  ///< a bound of its error
  Matrix<S> conditions;      ///< of Symmetry::computed: rows of equations for (w, t), see symmetry_conditions
};

}  // namespace hbvm::core
