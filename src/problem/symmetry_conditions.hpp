#pragma once

#include "linear/null_space.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// What a motion of space x -> w x x + t must fulfil to keep the kinetic energy, every effect and every constraint,
/// each by itself. It is rows of equations for (w, t), where w has three entries or in the plane one. Their error
/// bounds are the round-off of the scene's numbers, of which `unit` is the relative size. Call it within a
/// PrecisionScope of some more digits than those have.
template <Scalar S>
std::vector<UncertainRow> symmetry_conditions(const Problem<S>& problem, const Mpfr& unit);

}  // namespace hbvm::core
