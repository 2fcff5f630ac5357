#pragma once

#include <stop_token>
#include <string>

#include "lesson/measure.hpp"

namespace hbvm::core {

/// What the engine finds for a measure: its names, and the numbers in the JSON of the request's result, as text. Its
/// work ends after so many seconds, a minute, so that an answer cannot ask for any amount.
/// \throws InputError for what cannot be computed, or has no such value; IntegrationError; Interrupted if `stop` asks
NamedTexts measured_values(const Measure& measure, const std::stop_token& stop, double seconds = 60);

}  // namespace hbvm::core
