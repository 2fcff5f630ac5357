#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hbvm/horizon.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// Where a growth reaches so many digits. Beyond its last time it is continued.
/// \param times, lost ascending \param rate digits a unit of time beyond; 0 if they do not grow on
Horizon horizon_of(const std::string& precision, double digits, const std::vector<double>& times,
                   const std::vector<double>& lost, double rate);

/// By the growth of a small change of the scene's start, in few digits. The rate at the end is that of the second half
/// of the time. Less than a digit in it is a power of the time, and goes on as slowly: then there is no horizon beyond.
/// \param progress is called with the part that is done
/// \throws InputError for a run back in time, or from another start; Interrupted
DigitsLost digits_lost(const RunRequest& request, const std::function<void(double)>& progress);

/// What is lost by a time, between the points of the growth.
double lost_by(const DigitsLost& growth, double t);

}  // namespace hbvm::core
