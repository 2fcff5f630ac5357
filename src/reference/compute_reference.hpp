#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hbvm/reference.hpp"
#include "reference/effort.hpp"
#include "reference/route_run.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

struct KeptProof;

/// The ways to a reference solution that share nothing but the scene. They are the Taylor series of TaylorMotion,
/// HBVM(s,s) of high order with its output state, and the closed form where one is known.
enum class Route { taylor, hbvm, closed_form };
inline constexpr Route all_routes[] = {Route::taylor, Route::hbvm, Route::closed_form};
const char* name_of(Route route);
/// \throws InputError
Route parse_route(std::string_view name);

struct ReferenceRequest {
  Scene scene;
  std::vector<Expression> times;  ///< positive, ascending
  int digits = 30;
  std::optional<Route> only;  ///< one route alone: nothing is confirmed then
  /// Called now and then with the part that is done, from any thread; it may throw to end the work.
  std::function<void(double)> progress = {};
  LegKeeper keeper = {};  ///< where legs of the routes are found and kept
  /// Called with what each route will take, before it begins.
  std::function<void(const Effort&)> estimate = {};
  bool force = false;          ///< do also what will take more than a day, or more memory than most machines have
  bool prove = false;          ///< by bounds of the motion instead of two routes
  KeptProof* proof = nullptr;  ///< is given what proves it
};

/// What a route finds in the digits of its legs, of which all are to be right but so many. Nothing if it does not serve
/// a scene.
using RouteFunction = std::function<std::optional<RouteRun>(const RouteWork&, double spare)>;
/// The route of that name.
RouteFunction function_of(Route route);

/// The state at the times. Each digit is found by two routes, and by the closed form, too, of a motion that has one.
/// Order, step, precision and guard digits are chosen here. They follow from the growth of a small change of the start
/// and the radius of convergence of the series, at low precision. Where the routes agree in fewer digits, both are made
/// again with more.
/// \throws InputError for digits or times out of range, for what would take too long, or if `only` names an unknown
/// closed form
/// \throws IntegrationError where the motion ends, or the routes never agree, with both values
/// \param function what makes each route
Reference compute_reference(const ReferenceRequest& request,
                            const std::function<RouteFunction(Route)>& function = function_of);

/// A hash of what a scene says of the motion, whatever its name, its comments, what it observes and what it looks like.
std::string scene_hash(const Scene& scene);

inline constexpr int least_reference_digits = 1, most_reference_digits = 5000;

}  // namespace hbvm::core
