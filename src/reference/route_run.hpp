#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "method/hbvm_name.hpp"
#include "reference/route_legs.hpp"

namespace hbvm::core {

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
  const Scene& source;
  const Assembled<Mpfr>& scene;  ///< made of it in the digits of the scope
  const std::vector<Mpfr>& times;
  RouteProgress progress;
  std::vector<unsigned> leg_digits;  ///< of each part of the time: none has more than the scope, nor than one before
  LegKeeper keeper = {};
};

/// \throws IntegrationError
RouteRun taylor_route(const RouteWork& work);

/// The states by the scene's closed form, or nothing if none is known.
/// \throws IntegrationError
std::optional<RouteRun> closed_form_route(const RouteWork& work);

/// What a motion does to errors, and how far from the time axis its nearest singularity lies.
struct MotionNature {
  double digits_lost = 0;  ///< log10 of the factor by which a change of the start grows until the last time, at least 0
  double log2_radius = 0;  ///< least radius of convergence of the Taylor series
  double steps = 1;        ///< of a Taylor series until the last time
  /// log10 of what a change of the start has grown by at the end of each of equal parts of the time.
  std::vector<double> grown = {};

  /// Parts of the time that take some hundred steps of a Taylor series each.
  long legs() const;
  /// Digits that are lost until a part of the time, and those that a change made there loses until the end. Without
  /// `grown`, all are lost at any time.
  double lost_by(double part) const;
  double to_come(double part) const;
};

/// The stages s of HBVM(s,s) for so many digits, at most max_s.
int stages_of_route(double digits);
/// The most digits for which HBVM has the stages that it needs.
inline constexpr int most_digits_of_hbvm = 20 * max_s / 9;

/// The states by HBVM(s,s) by steps that it chooses itself, with all digits right but so many: see HbvmMotion.
/// \throws IntegrationError
RouteRun hbvm_route(const RouteWork& work, double spare);

/// The nature of a motion, from two motions at low precision that start close to each other. Where the change has grown
/// so far that it tells no more, its rate until then is taken for all of the time. The radius is taken for the least.
/// \param progress is called with the part of the time that is done, and may throw to end the work \throws
/// IntegrationError
MotionNature nature_of(const Scene& scene, const std::vector<Expression>& times, const RouteProgress& progress);

}  // namespace hbvm::core
