#pragma once

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// What a proof will take, as far as a survey of the growth of errors tells.
Effort proof_effort(const ReferenceRequest& request, const MotionNature& nature);

/// Fills in the states of a reference between bounds that are proved, see ProvedMotion. Each number's radius is at most
/// a hundredth of a unit of its last digit.
/// \throws InputError for a start that is consistent to its own digits only
/// \throws IntegrationError where nothing can be proved
void add_proved_states(Reference& reference, const ReferenceRequest& request);

}  // namespace hbvm::core
