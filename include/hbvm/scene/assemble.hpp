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

/// Evaluates a scene in the working precision. Coordinates: the bodies in file order, then the rigid bodies (reference
/// point unless fixed, directors). Constraints: those of the rigid bodies, then those of the file, in order.
/// \throws InputError for a mass that is not positive (definite), and for an initial state that is not consistent,
///         (consist0), naming the constraint and its residual: the tolerance is the round-off of the constraint's terms
template <Scalar S>
Assembled<S> assemble(const Scene& scene);

#define HBVM_DECLARE(S) extern template Assembled<S> assemble<S>(const Scene&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
