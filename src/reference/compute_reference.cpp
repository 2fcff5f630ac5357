#include "reference/compute_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>

#include "beside.hpp"
#include "checksum.hpp"
#include "clock.hpp"
#include "interruption.hpp"
#include "problem/redundant_constraints.hpp"
#include "reference/agreement.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "reference/effort.hpp"
#include "reference/observed_texts.hpp"
#include "reference/proved_reference.hpp"
#include "reference/reference_motion.hpp"
#include "reference/route_run.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/coordinate_names.hpp"
#include "thread_caches.hpp"

namespace hbvm::core {
namespace {

std::vector<Mpfr> evaluated(const std::vector<Expression>& times, const Constants& constants) {
  std::vector<Mpfr> result;
  for (const Expression& t : times) result.push_back(evaluate<Mpfr>(t, constants));
  return result;
}

void check(const ReferenceRequest& request) {
  if (request.digits < least_reference_digits || request.digits > most_reference_digits)
    throw InputError(fmt::format("a reference has {} to {} digits, not {}", least_reference_digits,
                                 most_reference_digits, request.digits));
  if (request.times.empty()) throw InputError("a reference needs a time");
  const PrecisionScope scope(50);
  Mpfr last = 0;
  for (const Expression& time : request.times) {
    const Mpfr t = evaluate<Mpfr>(time, request.scene.constants);
    if (!(t > last))
      throw InputError("the times of a reference are positive and ascend: '" + time.text() + "' does not");
    last = t;
  }
}

/// Looks at the clock while a motion is made at low precision: where that would take too long, all else would.
class Patience {
 public:
  explicit Patience(const ReferenceRequest& request) : request_(request), start_(elapsed_seconds()) {}

  /// \throws InputError
  void look(double part) {
    if (request_.progress) request_.progress(0);
    part_ = std::max(part_, part);
    constexpr double sure = 5;
    const double taken = elapsed_seconds() - start_;
    if (request_.force || taken < sure || taken < longest_effort * part_) return;
    throw InputError("t = " + request_.times.back().text() +
                     " is too far away: the motion at low precision alone takes " +
                     (part_ > 0 ? duration_text(taken / part_) : "more than a day") + "; --force does it all the same");
  }

 private:
  const ReferenceRequest& request_;
  double start_, part_ = 0;
};

/// Whether bounds of the motion take less than HBVM, the dearer of the routes.
bool proof_is_quicker(const ReferenceRequest& request, const MotionNature& nature) {
  // With fewer digits matrices cost a proof more than its series.
  constexpr int fewest = 150;
  if (request.only || request.keeper.find || request.digits < fewest) return false;
  const auto digits = static_cast<unsigned>(request.digits + std::ceil(nature.digits_lost));
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  if (!scene.settled.empty() || !scene.problem.is_conservative() || closed_form_of(scene) != nullptr) return false;
  const double by_hbvm = effort_of_hbvm(scene.problem, nature, digits).seconds;
  const auto serves = [&](const Effort& proof) {
    return proof.seconds < by_hbvm &&
           (request.force || (proof.seconds < longest_effort && proof.bytes < largest_effort));
  };
  if (!serves(effort_of_proof(scene.problem, nature, digits))) return false;
  const Effort proof = proof_effort(request, nature);
  if (!serves(proof)) return false;
  if (request.estimate) request.estimate(proof);
  return true;
}

/// Another route has failed, and nothing will be given out.
class Abandoned : public IntegrationError {
 public:
  using IntegrationError::IntegrationError;
};

/// The routes' runs at once, each in a thread of its own with its digits.
class Attempt {
 public:
  Attempt(const ReferenceRequest& request, const std::function<RouteFunction(Route)>& function,
          const MotionNature& nature, int guard)
      : request_(request),
        function_(function),
        nature_(nature),
        digits_(static_cast<unsigned>(request.digits + std::ceil(nature.digits_lost) + guard)),
        without_hbvm_(!request.only && closed_form_serves()) {}

  unsigned digits() const { return digits_; }

  /// What the routes will take. \throws InputError if that is too much
  void estimate() const {
    const PrecisionScope scope(digits_);
    const Assembled<Mpfr> scene = assemble<Mpfr>(request_.scene);
    std::vector<Effort> efforts;
    if (!request_.only || *request_.only == Route::taylor)
      efforts.push_back(effort_of_taylor(scene.problem, nature_, digits_));
    if (request_.only ? *request_.only == Route::hbvm : !without_hbvm_)
      efforts.push_back(effort_of_hbvm(scene.problem, nature_, digits_));
    constexpr double gigabyte = 1'000'000'000;
    for (const Effort& effort : efforts) {
      if (request_.estimate) request_.estimate(effort);
      if (request_.force || (effort.seconds < longest_effort && effort.bytes < largest_effort)) continue;
      throw InputError(fmt::format(
          "{} digits of '{}' at t = {}: route {} would take about {} and {:.2g} GB; ask for less{}, or say --force",
          request_.digits, request_.scene.name, request_.times.back().text(), effort.route,
          duration_text(effort.seconds), effort.bytes / gigabyte,
          effort.route == "hbvm" ? ", or for --route taylor alone, which nothing confirms" : ""));
    }
  }

  /// \throws InputError if there is no such route for this scene
  std::vector<NamedRun> run() {
    std::vector<std::pair<Route, std::future<std::optional<RouteRun>>>> futures;
    for (const Route route : all_routes)
      if (request_.only ? *request_.only == route : route != Route::hbvm || !without_hbvm_)
        futures.emplace_back(route, std::async(beside, [this, route, asker = stop_request] {
                               const StopScope scope(asker);
                               const ThreadCaches freed;
                               return run(route);
                             }));
    std::vector<NamedRun> runs;
    std::exception_ptr failure;
    for (auto& [route, future] : futures) try {
        if (auto run = future.get()) runs.push_back({name_of(route), std::move(*run)});
      } catch (const Abandoned&) {
      } catch (const IntegrationError&) {
        // Two others confirm one another without the closed form.
        if (!failure && (route != Route::closed_form || runs.size() < 2)) failure = std::current_exception();
      } catch (...) {
        failure = std::current_exception();
      }
    if (failure) std::rethrow_exception(failure);
    if (runs.empty()) throw InputError("no closed form of the motion of '" + request_.scene.name + "' is known");
    return runs;
  }

 private:
  /// HBVM has not stages enough for very many digits, and would take ten times as long as Taylor series and more. There
  /// a closed form confirms them as well.
  bool closed_form_serves() const {
    if (static_cast<int>(digits_) <= most_digits_of_hbvm) return false;
    const PrecisionScope scope(digits_);
    return closed_form_of(assemble<Mpfr>(request_.scene)) != nullptr;
  }

  /// A failure ends the other routes, too, but that of a closed form, which they may do without.
  std::optional<RouteRun> run(Route route) {
    try {
      return find(route);
    } catch (...) {
      if (route != Route::closed_form) failed_ = true;
      throw;
    }
  }

  std::optional<RouteRun> find(Route route) {
    const PrecisionScope scope(digits_);
    const Assembled<Mpfr> scene = assemble<Mpfr>(request_.scene);
    const std::vector<Mpfr> times = evaluated(request_.times, request_.scene.constants);
    const RouteProgress progress = [&](double part) {
      if (failed_) throw Abandoned("another route has failed");
      if (!request_.progress) return;
      const std::lock_guard lock(reporting_);
      if (route == Route::taylor) taylor_done_ = part;
      if (route == Route::hbvm) hbvm_done_ = part;
      request_.progress(request_.only ? part : without_hbvm_ ? taylor_done_ : std::min(taylor_done_, hbvm_done_));
    };
    // For the sum of errors.
    constexpr int few = 3;
    return function_(route)({request_.scene, scene, times, progress, leg_digits(), keeper(route)}, few);
  }

  /// A leg needs the digits that are asked for, and those that are still to be lost.
  std::vector<unsigned> leg_digits() const {
    std::vector<unsigned> digits;
    const long legs = nature_.legs();
    for (long n = 0; n < legs; ++n) {
      const double saved = nature_.digits_lost - nature_.to_come(static_cast<double>(n) / static_cast<double>(legs));
      digits.push_back(digits_ - static_cast<unsigned>(saved));
    }
    return digits;
  }

  /// Under keys that say what a leg depends on.
  LegKeeper keeper(Route route) const {
    if (!request_.keeper.find) return {};
    std::string work = fmt::format("{} {} {} digits", scene_hash(request_.scene), name_of(route), digits_);
    for (const Expression& time : request_.times) work += " " + time.text();
    const LegKeeper& all = request_.keeper;
    return {[work, &all](const std::string& key) { return all.find(work + " " + key); },
            [work, &all](const std::string& key, const std::string& json) { all.keep(work + " " + key, json); }};
  }

  const ReferenceRequest& request_;
  const std::function<RouteFunction(Route)>& function_;
  const MotionNature& nature_;
  unsigned digits_;
  bool without_hbvm_;
  double taylor_done_ = 0, hbvm_done_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex reporting_;
};

}  // namespace

const char* name_of(Route route) {
  return route == Route::taylor ? "taylor" : route == Route::hbvm ? "hbvm" : "closed_form";
}

Route parse_route(std::string_view name) {
  for (const Route route : all_routes)
    if (name == name_of(route)) return route;
  throw InputError("unknown route '" + std::string(name) + "': there are taylor, hbvm and closed_form");
}

std::string scene_hash(const Scene& scene) {
  Scene plain = scene;
  plain.name = plain.title = plain.source = "";
  plain.observations.clear();
  plain.events.clear();
  for (SceneRigidBody& body : plain.rigid_bodies) body.shape.reset();
  return Checksum(write_scene(plain)).text();
}

RouteFunction function_of(Route route) {
  if (route == Route::taylor) return [](const RouteWork& work, double) { return taylor_route(work); };
  if (route == Route::hbvm) return hbvm_route;
  return [](const RouteWork& work, double) { return closed_form_route(work); };
}

Reference compute_reference(const ReferenceRequest& request, const std::function<RouteFunction(Route)>& function) {
  check(request);
  Patience patience(request);
  const MotionNature nature = nature_of(request.scene, request.times, [&](double part) { patience.look(part); });
  constexpr int rounds = 3, first_guard = 10, more_guard = 8;
  Reference result{.scene = request.scene.name,
                   .title = request.scene.title,
                   .scene_hash = scene_hash(request.scene),
                   .digits = request.digits,
                   .q_names = coordinate_names(request.scene),
                   .p_names = coordinate_names(request.scene, "p"),
                   .lambda_names = {},
                   .times = {},
                   .momentum_names = {},
                   .observed_names = {},
                   .routes = {},
                   .digits_lost = nature.digits_lost};
  result.scene_toml = write_scene(request.scene);
  if (request.prove) {
    add_proved_states(result, request);
    return result;
  }
  if (proof_is_quicker(request, nature)) try {
      add_proved_states(result, request);
      return result;
    } catch (const IntegrationError&) {
      // The routes may go where no bounds do, or say what is in their way.
    }
  int guard = first_guard;
  for (int round = 1;; ++round) {
    Attempt attempt(request, function, nature, guard);
    attempt.estimate();
    const std::vector<NamedRun> runs = attempt.run();
    const PrecisionScope scope(attempt.digits());
    const Assembled<Mpfr> assembled = assemble<Mpfr>(request.scene);
    const Agreement agreement(assembled, request.times, runs, request.digits);
    if (!agreement.holds()) {
      if (round == rounds) agreement.require();
      guard += static_cast<int>(std::max(0L, request.digits + 1 - agreement.digits())) + more_guard;
      continue;
    }
    result.times = agreement.states();
    const std::vector<Mpfr> times = evaluated(request.times, request.scene.constants);
    for (std::size_t n = 0; n < times.size(); ++n)
      result.times[n].digits_lost = nature.lost_by(approximately(Mpfr(times[n] / times.back())));
    result.momentum_names = agreement.momentum_names();
    result.lambda_names = names_of_constraints(assembled.problem);
    std::vector<std::vector<ExactPoint>> points;
    for (const NamedRun& run : runs) points.push_back(run.run.points);
    points.push_back(shaken(points.front()));
    add_observed_texts(result, request, assembled.problem, points);
    for (const NamedRun& run : runs) result.routes.push_back({run.name, run.run.settings, run.run.cpu_seconds});
    return result;
  }
}

}  // namespace hbvm::core
