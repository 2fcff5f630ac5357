#pragma once

#include "hbvm/problem/problem.hpp"
#include "hbvm/scene/scene.hpp"

namespace hbvm {

/// A scene in one precision: the problem and its initial state.
template <Scalar S>
struct Assembled {
  Problem<S> problem;
  Vector<S> q0, p0;
};

/// Whether an initial state that breaks the constraints is refused.
enum class Consistency { checked, unchecked };

/// Evaluates a scene in the working precision. Coordinates: the bodies in file order, then the rigid bodies (reference
/// point unless fixed, directors). Constraints: those of the rigid bodies, then those of the file, in order.
/// \throws InputError for a mass that is not positive (definite); if checked, also for an initial state that is not
///         consistent, (consist0), naming the constraint and its residual (the tolerance is the round-off of the
///         constraint's terms), and for constraints that are redundant or contradictory there
template <Scalar S>
Assembled<S> assemble(const Scene& scene, Consistency consistency = Consistency::checked);

#define HBVM_DECLARE(S) extern template Assembled<S> assemble<S>(const Scene&, Consistency);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
