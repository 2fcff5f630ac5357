#include "hbvm/reference/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <mutex>

#include "hbvm/checksum.hpp"
#include "hbvm/reference/agreement.hpp"
#include "hbvm/reference/closed_form/closed_form.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/reference/route_run.hpp"
#include "hbvm/reference/taylor.hpp"
#include "hbvm/scalar/literal.hpp"

namespace hbvm {
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

/// \throws InputError for a time that nobody can wait for
void refuse_endless(const ReferenceRequest& request) {
  const PrecisionScope scope(30);
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  const Mpfr end = evaluate<Mpfr>(request.times.back(), request.scene.constants);
  constexpr double most = 40;
  if (log2_of(end) - motion.least_radius() > most)
    throw InputError("t = " + request.times.back().text() +
                     " is more than 10^12 steps of a Taylor series away: no reference gets there");
}

/// The routes' runs at once, each in a thread of its own with its digits.
class Attempt {
 public:
  Attempt(const ReferenceRequest& request, const MotionNature& nature, int guard)
      : request_(request),
        nature_(nature),
        digits_(static_cast<unsigned>(request.digits + std::ceil(nature.digits_lost) + guard)),
        without_hbvm_(!request.only && closed_form_serves()) {}

  unsigned digits() const { return digits_; }

  /// \throws InputError if there is no such route for this scene
  std::vector<NamedRun> run() {
    std::vector<std::pair<Route, std::future<std::optional<RouteRun>>>> futures;
    for (const Route route : all_routes)
      if (request_.only ? *request_.only == route : route != Route::hbvm || !without_hbvm_)
        futures.emplace_back(route, std::async(std::launch::async, [this, route] { return run(route); }));
    std::vector<NamedRun> runs;
    std::exception_ptr failure;
    for (auto& [route, future] : futures) try {
        if (auto run = future.get()) runs.push_back({name_of(route), std::move(*run)});
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    if (failure) std::rethrow_exception(failure);
    if (runs.empty()) throw InputError("no closed form of the motion of '" + request_.scene.name + "' is known");
    return runs;
  }

 private:
  /// Where HBVM has not stages enough for so many digits it would take ten times as long as Taylor series and more; a
  /// closed form confirms them as well.
  bool closed_form_serves() const {
    if (static_cast<int>(digits_) <= most_digits_of_hbvm) return false;
    const PrecisionScope scope(digits_);
    return closed_form_of(assemble<Mpfr>(request_.scene)) != nullptr;
  }

  std::optional<RouteRun> run(Route route) {
    const PrecisionScope scope(digits_);
    const Assembled<Mpfr> scene = assemble<Mpfr>(request_.scene);
    const std::vector<Mpfr> times = evaluated(request_.times, request_.scene.constants);
    const RouteProgress progress = [&](double part) {
      if (!request_.progress) return;
      const std::lock_guard lock(reporting_);
      if (route == Route::taylor) taylor_done_ = part;
      if (route == Route::hbvm) hbvm_done_ = part;
      request_.progress(request_.only || without_hbvm_ ? part : std::min(taylor_done_, hbvm_done_));
    };
    const RouteWork work{scene, times, progress, nature_.legs, keeper(route)};
    if (route == Route::taylor) return taylor_route(work);
    if (route == Route::closed_form) return closed_form_route(work);
    // What errors grow by, and a few for their sum.
    constexpr int few = 3;
    return hbvm_route(work, static_cast<double>(digits_) - few, nature_);
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
  const MotionNature& nature_;
  unsigned digits_;
  bool without_hbvm_;
  double taylor_done_ = 0, hbvm_done_ = 0;
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
  return Checksum(write_scene(plain)).text();
}

Reference compute_reference(const ReferenceRequest& request) {
  check(request);
  refuse_endless(request);
  MotionNature nature = nature_of(request.scene, request.times, [&](double part) {
    if (request.progress) request.progress(part);
  });
  constexpr int rounds = 3, first_guard = 10, more_guard = 8;
  Reference result{.scene = request.scene.name,
                   .title = request.scene.title,
                   .scene_hash = scene_hash(request.scene),
                   .digits = request.digits,
                   .times = {},
                   .momentum_names = {},
                   .routes = {},
                   .digits_lost = nature.digits_lost};
  int guard = first_guard;
  for (int round = 1;; ++round) {
    Attempt attempt(request, nature, guard);
    const std::vector<NamedRun> runs = attempt.run();
    const PrecisionScope scope(attempt.digits());
    const Agreement agreement(assemble<Mpfr>(request.scene), request.times, runs, request.digits);
    if (!agreement.holds()) {
      if (round == rounds) agreement.require();
      // What the radius of convergence is later on may not have shown.
      nature.log2_radius -= 1;
      guard += static_cast<int>(std::max(0L, request.digits + 1 - agreement.digits())) + more_guard;
      continue;
    }
    result.times = agreement.states();
    result.momentum_names = agreement.momentum_names();
    for (const NamedRun& run : runs) result.routes.push_back({run.name, run.run.settings, run.run.cpu_seconds});
    return result;
  }
}

}  // namespace hbvm
