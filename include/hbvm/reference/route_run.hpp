#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/method/hbvm_name.hpp"
#include "hbvm/reference/route_legs.hpp"

namespace hbvm {

/// What one route found, and how, in the digits of its scope.
struct RouteRun {
  std::string settings;
  double cpu_seconds = 0;
  std::vector<ExactPoint> points;
};

/// Called with the part of the time that is done.
using RouteProgress = std::function<void(double)>;

/// What a route is to find: the states at times that ascend, in the digits of the scope.
struct RouteWork {
  const Assembled<Mpfr>& scene;
  const std::vector<Mpfr>& times;
  RouteProgress progress;
  long legs = 1;  ///< parts of the time that are kept
  LegKeeper keeper = {};
};

/// \throws IntegrationError
RouteRun taylor_route(const RouteWork& work);

/// A part of the time, from the one before, and how many doublings its least radius of convergence is above the least
/// of all.
struct Calm {
  double until = 0;
  int doublings = 0;
};

/// The states by the scene's closed form, or nothing if none is known.
/// \throws IntegrationError
std::optional<RouteRun> closed_form_route(const RouteWork& work);

/// What a motion does to errors, and how far from the time axis its nearest singularity lies.
struct MotionNature {
  double digits_lost = 0;  ///< log10 of the factor by which a change of the start grows until the last time, at least 0
  double log2_radius = 0;  ///< least radius of convergence of the Taylor series
  std::vector<Calm> calm = {};  ///< parts of the time from 0 on; after the last it is the least
  long legs = 1;                ///< parts of the time that take some hundred steps of a Taylor series each
};

/// With so many digits HBVM has not the stages that it would need.
inline constexpr int most_digits_of_hbvm = 20 * max_s / 9;

/// The states by HBVM(s,s) with so many digits right, if the motion is analytic within 2^log2_radius of the time axis,
/// and farther where it is calm: steps are longer there.
/// \throws IntegrationError
RouteRun hbvm_route(const RouteWork& work, double digits, const MotionNature& nature);

/// From two motions at low precision, the start of one changed a little. Where the change has grown so far that it
/// tells no more, its rate until then is taken for that of all the time, and the radius for the least. \param progress
/// is called with 0 now and then, and may throw to end the work \throws IntegrationError
MotionNature nature_of(const Scene& scene, const std::vector<Expression>& times, const RouteProgress& progress);

}  // namespace hbvm
