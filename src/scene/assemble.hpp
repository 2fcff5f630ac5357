#pragma once

#include "problem/problem.hpp"
#include "scene/effect_reach.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// A constraint that follows from others at the start, so that it is integrated without and only watched; of a joint
/// all that do.
struct Redundancy {
  std::string name;                 ///< "constraint 3 (rod 'a'-'c')", "constraints 21 and 22 (hinge 'a'-'b')"
  std::vector<std::string> others;  ///< those it follows from, joints and rigid bodies named once
};
/// "constraint 3 (rod 'a'-'c') follows from constraint 1 (rod 'a'-'b'), hinge 'c'-'d', and 3 more".
std::string to_text(const Redundancy& redundancy);

/// A scene in one precision: the problem and its initial state.
template <Scalar S>
struct Assembled {
  Problem<S> problem;
  Vector<S> q0, p0;
  std::vector<Redundancy> redundant = {};     ///< a finding each; the constraints are in problem.redundant
  std::vector<EffectReach> reach = {};        ///< of each term of the potential
  std::vector<EffectReach> force_reach = {};  ///< of each effect that is a force without one
  std::string settled = {};  ///< how the start was moved to where the constraints hold; empty if it was not
};

/// Whether an initial state that breaks the constraints is refused.
enum class Consistency { checked, unchecked };

/// Evaluates a scene in the working precision. Coordinates: the bodies in file order, then the rigid bodies (reference
/// point unless fixed, directors). Constraints: those of the rigid bodies, then those of the file, in order. If
/// checked, constraints that follow from others at the start, which leave the multipliers undetermined, are set aside;
/// those that stand best apart are kept. A start may be consistent to the digits it is written with, 15 or more. It is
/// then moved to the nearest one that is consistent in S, if S has more. \throws InputError for Mpfr without a
/// PrecisionScope; for a mass that is not positive (definite), for a rigid body that no distribution of mass makes,
///         and for an effect that acts on nobody; if checked, also for an initial state that is not
///         consistent, (7), naming the constraint and its residual (the tolerance is the round-off of the
///         constraint's terms), for constraints whose gradient vanishes there, for contradictory ones, and for those
///         whose Gram matrix is singular to the working precision
template <Scalar S>
Assembled<S> assemble(const Scene& scene, Consistency consistency = Consistency::checked);

}  // namespace hbvm::core
