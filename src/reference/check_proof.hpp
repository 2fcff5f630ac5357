#pragma once

#include <functional>

#include "reference/proof_file.hpp"

namespace hbvm::core {

/// Goes through a proof again, each step by itself, on all processors. From the bounds at a step's start those at its
/// end have to follow. Steps have to join, and the reference has to be what they prove.
/// \return that reference
/// \param progress is called with the part that is done, from any thread, and may throw to end the work
/// \throws InputError for a proof of another scene than it says
/// \throws IntegrationError where it does not hold, with the step
Reference check_proof(const ProofFile& file, const std::function<void(double)>& progress);

}  // namespace hbvm::core
