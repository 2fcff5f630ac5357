#pragma once

#include <functional>
#include <vector>

#include "scene/assemble.hpp"

namespace hbvm::core {

/// How errors grow along a motion, looked at in few digits. It proves nothing; it says what a proof will need.
struct GrowthSurvey {
  double growth = 0;  ///< log10 of what bounds of errors will grow by
  double steps = 1;
  std::vector<double> times, omegas;  ///< omega of ErrorGrowth up to each time, with which errors grow least

  double omega_at(double t) const;
};

/// \param progress is called with the part of the time that is done, and may throw to end the work
/// \throws IntegrationError where the motion ends
GrowthSurvey survey_growth(const Scene& scene, const Expression& until, const std::function<void(double)>& progress);

}  // namespace hbvm::core
