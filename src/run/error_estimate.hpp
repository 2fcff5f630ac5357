#pragma once

#include <string>
#include <vector>

#include "hbvm/run.hpp"
#include "integrate/output_state.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// \param method with the k that was chosen \param start where the run began, if not at the start of its scene
/// \param output_lambda of all constraints
template <Scalar S>
ErrorEstimate estimate_error(const RunRequest& request, const Method& method, const std::optional<State<S>>& start,
                             const Vector<S>& q, const Vector<S>& output_p, const Vector<S>& output_lambda);

}  // namespace hbvm::core
