#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "run/tangent_space.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

struct PeriodicRequest {
  Scene scene;       ///< whose start is near the motion that is looked for
  Expression until;  ///< before which that comes back
  std::optional<Expression> plane =
      {};  ///< an observation that is 0 at its start; without, it starts beside the scene's
  int digits = 30;
  std::function<void(double part)> progress = {};
};

/// A motion that comes back to its start, of the same H as that of the scene.
struct PeriodicOrbit {
  PhaseState start;
  Mpfr period, H;
  Mpfr q_size, p_size, H_size;  ///< by which what vanishes is measured
  long agreed = 0;              ///< digits in which the two routes of a reference agree on it
  int iterations = 0;           ///< of Newton's method
  std::vector<std::complex<double>> multipliers;
};

/// Newton's method for a start x and a period T with x(T) = x, H(x) = H_0, and the plane at 0. Without a plane, the
/// start moves across the motion. The flow is that of Taylor series, its derivative a quotient in few digits, which
/// leads to any number of them. Where other quantities are conserved, too, the solution nearest to the start is taken.
/// A step of Newton's method by the flow of HBVM tells in how many digits the routes agree.
/// \throws InputError for forces without a potential; IntegrationError if there is no such motion nearby; Interrupted
PeriodicOrbit periodic_orbit(const PeriodicRequest& request);

}  // namespace hbvm::core
