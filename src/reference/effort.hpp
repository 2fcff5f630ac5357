#pragma once

#include <string>
#include <vector>

#include "reference/route_run.hpp"

namespace hbvm::core {

/// The time and memory that a route will take, extrapolated from a motion at low precision. It is right to a small
/// factor.
struct Effort {
  std::string route;
  double seconds = 0, bytes = 0;
};

/// The effort of a Taylor series with so many digits.
Effort effort_of_taylor(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits);
/// The effort of HBVM(s,s) with so many digits.
Effort effort_of_hbvm(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits);

/// The effort of a proof, whose series have so many digits.
Effort effort_of_proof(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits);

/// "3 minutes", "2.5 days", "4e+06 years".
std::string duration_text(double seconds);

/// Work that takes longer is refused unless it is forced.
inline constexpr double longest_effort = 24 * 3600;
inline constexpr double largest_effort = 16'000'000'000;

}  // namespace hbvm::core
