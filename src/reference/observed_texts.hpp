#pragma once

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// The states with their last digits changed, each component another way. Rounding that a formula magnifies is alike in
/// all that find a state, and shows where the state is changed.
std::vector<ExactPoint> shaken(std::vector<ExactPoint> points);

/// Fills in what the scene observes, at each time of the reference, in the digits of the scope.
/// \param points  at each time, by each that found them: the texts have the digits in which they agree
void add_observed_texts(Reference& reference, const ReferenceRequest& request, const Problem<Mpfr>& problem,
                        const std::vector<std::vector<ExactPoint>>& points);

}  // namespace hbvm::core
