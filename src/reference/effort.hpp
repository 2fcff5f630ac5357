#pragma once

#include <string>
#include <vector>

#include "reference/route_run.hpp"

namespace hbvm::core {

/// What a route will take, from what a motion at low precision took: to be believed within a factor of some.
struct Effort {
  std::string route;
  double seconds = 0, bytes = 0;
};

/// Of a Taylor series with so many digits.
Effort effort_of_taylor(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits);
/// Of HBVM(s,s) with so many digits.
Effort effort_of_hbvm(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits);

/// "3 minutes", "2.5 days", "4e+06 years".
std::string duration_text(double seconds);

/// Work that takes longer is refused unless it is forced.
inline constexpr double longest_effort = 24 * 3600;
inline constexpr double largest_effort = 16'000'000'000;

}  // namespace hbvm::core
