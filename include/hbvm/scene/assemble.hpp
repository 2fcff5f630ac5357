#pragma once

#include "hbvm/problem/problem.hpp"
#include "hbvm/scene/scene.hpp"

namespace hbvm {

/// A constraint that follows from others at the start, so that it is integrated without and only watched.
struct Redundancy {
  std::string name;                 ///< "constraint 3 (rod 'a'-'c')"
  std::vector<std::string> others;  ///< those it follows from, named likewise
};
/// "constraint 3 (rod 'a'-'c') follows from constraint 1 (rod 'a'-'b'), ..."
std::string to_text(const Redundancy& redundancy);

/// A scene in one precision: the problem and its initial state.
template <Scalar S>
struct Assembled {
  Problem<S> problem;
  Vector<S> q0, p0;
  std::vector<Redundancy> redundant = {};  ///< a finding each; the constraints are in problem.redundant
};

/// Whether an initial state that breaks the constraints is refused.
enum class Consistency { checked, unchecked };

/// Evaluates a scene in the working precision. Coordinates: the bodies in file order, then the rigid bodies (reference
/// point unless fixed, directors). Constraints: those of the rigid bodies, then those of the file, in order.
/// If checked, constraints that follow from others at the start, which leave the multipliers undetermined, are set
/// aside; those that stand best apart are kept.
/// \throws InputError for a mass that is not positive (definite); if checked, also for an initial state that is not
///         consistent, (consist0), naming the constraint and its residual (the tolerance is the round-off of the
///         constraint's terms), for constraints whose gradient vanishes there, for contradictory ones, and for those
///         whose Gram matrix is singular to the working precision
template <Scalar S>
Assembled<S> assemble(const Scene& scene, Consistency consistency = Consistency::checked);

#define HBVM_DECLARE(S) extern template Assembled<S> assemble<S>(const Scene&, Consistency);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
