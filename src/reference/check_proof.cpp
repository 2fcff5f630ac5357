#include "reference/check_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <thread>

#include "beside.hpp"
#include "interruption.hpp"
#include "reference/proved_states.hpp"
#include "scalar/literal.hpp"
#include "scene/coordinate_names.hpp"
#include "thread_caches.hpp"

namespace hbvm::core {
namespace {

constexpr slong bits_of_bounds = 64;

[[noreturn]] void refuse(std::size_t step, const std::string& why) {
  throw IntegrationError(fmt::format("step {} of the proof does not hold: {}", step + 1, why));
}

bool is_bound(const ErrorDistance& distance) {
  return distance.length.is_finite() && arb_is_nonnegative(raw(distance.length)) != 0 && distance.omega > 0 &&
         std::isfinite(distance.omega);
}

/// Whether numbers are what they are called, which the bounds take for granted.
void check_form(const ProvedStep& step, std::size_t n, const BallProblem& problem) {
  const SeriesStep& series = step.series;
  if (static_cast<Index>(series.q().size()) != problem.m() ||
      static_cast<Index>(series.lambda().size()) != problem.nu())
    refuse(n, fmt::format("it has {} positions and {} multipliers, and the scene {} and {}", series.q().size(),
                          series.lambda().size(), problem.m(), problem.nu()));
  if (!is_bound(step.before) || !is_bound(step.tube) || !is_bound(step.after)) refuse(n, "a distance is no bound");
  if (step.tube.omega != step.before.omega) refuse(n, "its tube is measured by another rate than its start");
  RealBall from;
  for (const PieceEnd& piece : step.pieces) {
    if (!from.is_below(piece.end) || !(piece.omega > 0) || !std::isfinite(piece.omega))
      refuse(n, "its pieces do not follow one another");
    from = piece.end;
  }
  if (arb_equal(raw(from), raw(series.end())) == 0) refuse(n, "its last piece does not end where it ends");
}

bool is_at_most(const RealBall& x, const RealBall& bound) { return arb_le(raw(x), raw(bound)) != 0; }

/// What follows from the start of a step. \throws IntegrationError if that is not what the proof says
StepCourse checked(const std::vector<ProvedStep>& steps, std::size_t n, StepBounds& bounds) {
  const ProvedStep& step = steps[n];
  check_form(step, n, bounds.problem());
  const BallScope scope(bits_of_bounds);
  const double omega = step.before.omega;
  RealBall start;
  if (n == 0)
    start = bounds.distance_of_start(step.series, omega);
  else if (steps[n - 1].series.q().size() == step.series.q().size())
    start = steps[n - 1].after.measured_by(omega).length + bounds.jump(steps[n - 1].series, step.series, omega);
  if (!is_at_most(start, step.before.length)) refuse(n, "it begins farther away than it says");
  StepCourse course;
  try {
    course = bounds.course(step.series, bounds.defect(step.series), step.tube, step.pieces);
  } catch (const IntegrationError& error) {
    refuse(n, error.what());
  }
  if (!course.stays_in_tube(step.before)) refuse(n, "the motion may leave the tube");
  const ErrorDistance end = course.distance_at(step.series.end(), step.before).measured_by(step.after.omega);
  if (!is_at_most(end.length, step.after.length)) refuse(n, "it ends farther away than it says");
  return course;
}

/// Each in a thread that takes the next step that nobody has taken.
std::vector<StepCourse> check_steps(const KeptProof& proof, const Assembled<Mpfr>& exact,
                                    const std::function<void(double)>& progress) {
  std::vector<StepCourse> courses(proof.steps.size());
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> failed = false;
  const auto work = [&, asker = stop_request] {
    const StopScope stop(asker);
    const ThreadCaches freed;
    const PrecisionScope scope(proof.digits);
    const auto look = [&] { progress(static_cast<double>(done) / static_cast<double>(courses.size())); };
    try {
      StepBounds bounds(exact, look);
      for (std::size_t n; !failed && (n = next++) < courses.size(); ++done)
        courses[n] = checked(proof.steps, n, bounds);
    } catch (...) {
      failed = true;
      throw;
    }
  };
  std::vector<std::future<void>> workers;
  const std::size_t count = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, courses.size());
  for (std::size_t i = 0; i < count; ++i) workers.push_back(std::async(beside, work));
  std::exception_ptr failure;
  for (std::future<void>& worker : workers) try {
      worker.get();
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
  return courses;
}

/// The states at the times of the reference.
ProvedStates states_of(const KeptProof& proof, const ReferenceRequest& request, const Assembled<Mpfr>& exact,
                       const std::vector<StepCourse>& courses) {
  ProvedStates states(request.scene);
  StepBounds bounds(exact, [] {});
  const BallScope scope(bounds.bits());
  RealBall start;
  std::size_t n = 0;
  for (const Expression& time : request.times) {
    const RealBall t = time_for_proof(time, request.scene.constants);
    for (;; ++n) {
      if (n == proof.steps.size()) throw IntegrationError("the proof ends before t = " + time.text());
      const ProvedStep& step = proof.steps[n];
      const RealBall s = (t - start) / step.series.unit();
      if (s.is_below(step.series.end())) {
        if (arb_is_nonnegative(raw(s)) == 0) refuse(n, "t = " + time.text() + " is where it begins, but for rounding");
        states.add(bounds.state(step.series, s, courses[n].distance_at(s, step.before)));
        break;
      }
      start = step.series.end_time(start);
    }
  }
  return states;
}

}  // namespace

Reference check_proof(const ProofFile& file, const std::function<void(double)>& progress) {
  const Reference& claim = file.claim.reference;
  ReferenceRequest request;
  request.scene = read_scene(file.proof.scene, claim.scene);
  if (scene_hash(request.scene) != claim.scene_hash)
    throw InputError("the proof is of a scene with the hash " + scene_hash(request.scene) + ", and its reference of " +
                     claim.scene_hash);
  for (const ReferenceState& state : claim.times) request.times.push_back(Expression::parse(state.t));
  request.digits = claim.digits;
  if (claim.proved != claim.digits || request.times.empty() || file.proof.steps.empty())
    throw InputError("the reference of the proof has no digits that it calls proved");
  const PrecisionScope scope(file.proof.digits);
  const Assembled<Mpfr> exact = assembled_for_proof(request.scene);
  const ProvedStates states = states_of(file.proof, request, exact, check_steps(file.proof, exact, progress));
  const Agreement agreement(states.scene, request.times, {states.run}, request.digits);
  if (!agreement.holds() || states.missing_digits(request.digits) > 0)
    throw IntegrationError("the bounds of the proof are wider than its digits");
  Reference found = claim;
  found.title = request.scene.title;
  found.scene_toml = file.proof.scene;
  found.q_names = coordinate_names(request.scene);
  found.p_names = coordinate_names(request.scene, "p");
  found.routes.clear();
  states.write(found, request, agreement);
  for (const Difference& d : differences(claim, found))
    throw IntegrationError(
        fmt::format("at t = {} the proof says {} = {}, and proves {}", d.t, d.what, d.stored, d.found));
  for (std::size_t n = 0; n < found.times.size(); ++n) {
    const std::optional<ProvedRadius>&said = claim.times[n].radius, &is = found.times[n].radius;
    const auto check = [&](const std::string& what, const std::string& a, const std::string& b) {
      if (literal<Mpfr>(a) < literal<Mpfr>(b))
        throw IntegrationError(
            fmt::format("at t = {} the proof says that {} is within {}, and proves {}", claim.times[n].t, what, a, b));
    };
    if (!said) throw InputError("the reference of the proof has no radius at t = " + claim.times[n].t);
    check("q", said->q, is->q);
    check("p", said->p, is->p);
    check("lambda", said->lambda, is->lambda);
    check("H", said->H, is->H);
  }
  found.routes = claim.routes;
  return found;
}

}  // namespace hbvm::core
