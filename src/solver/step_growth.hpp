#pragma once

#include "solver/branch_guard.hpp"
#include "solver/newton_iteration.hpp"

namespace hbvm::core {

/// Follows the solution from a step 2^-halvings as long to the full one, by steps that grow as fast as Newton's
/// iteration can follow. In the first of them the constant v = p0 is a good start if it ever is.
/// \return the number of residuals
/// \throws StageFailure
template <Scalar S>
long grow(NewtonIteration<S>& iteration, BranchGuard<S>& guard, const StepStart<S>& from, int halvings);

}  // namespace hbvm::core
