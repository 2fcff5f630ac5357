#pragma once

#include "run/proof/prove_steps.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// A proof is one of HBVM(k, s), from the start of the scene, by steps that are not divided. \throws InputError if
/// something else is asked for
void check_provable(const RunRequest& request);

/// \param method with the k that was chosen \param nodes  what became of it \param end  of the run
/// \throws as prove_steps does; InputError if k was raised on the way
template <Scalar S>
ProvedSteps prove_run(const RunRequest& request, const Method& method, const NodeLog& nodes, const State<S>& end,
                      const std::function<void(long, long)>& progress);

}  // namespace hbvm::core
