#pragma once

#include "reference/proof/series_step.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {

/// The step under way as polynomials with exact coefficients.
SeriesStep step_of(const TaylorMotion& motion, const BallProblem& problem);

}  // namespace hbvm::core
