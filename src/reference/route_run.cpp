#include "reference/route_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clock.hpp"
#include "hbvm_motion.hpp"
#include "linear/rounded.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/reference_motion.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// "60", or "60 to 33".
std::string range_text(long first, long last) {
  return first == last ? std::to_string(first) : fmt::format("{} to {}", first, last);
}

/// The digits of the first leg and of the last.
std::string digits_text(const std::vector<unsigned>& of_legs) { return range_text(of_legs.front(), of_legs.back()); }

/// The way by motions, one a leg, that make(problem, q, p, length, done) begins, in the digits of the leg. `done` stays
/// the part of the time that is done.
template <class Make>
Leg way_by(const RouteWork& work, const Make& make) {
  const auto run = [&](std::size_t number, const Mpfr& begin, const Mpfr& end, const std::vector<Mpfr>& times,
                       const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
    const double before = thread_seconds();
    double done = approximately(Mpfr(begin / work.times.back()));
    const bool fewer = work.leg_digits[number] < static_cast<unsigned>(digits10<Mpfr>());
    const PrecisionScope scope(work.leg_digits[number]);
    const std::optional<Assembled<Mpfr>> in_fewer = fewer ? std::optional(assemble<Mpfr>(work.source)) : std::nullopt;
    auto motion = make((in_fewer ? *in_fewer : work.scene).problem, rounded<Mpfr>(q), rounded<Mpfr>(p),
                       rounded_to<Mpfr>(raw(Mpfr(end - begin))), done);
    const auto advance_to = [&](const Mpfr& t) {
      motion.advance_to(rounded_to<Mpfr>(raw(Mpfr(t - begin))), [&](const Mpfr& now) {
        done = approximately(Mpfr((begin + now) / work.times.back()));
        work.progress(done);
      });
    };
    Leg leg;
    for (const Mpfr& t : times) {
      advance_to(t);
      leg.points.push_back(motion.output());
    }
    advance_to(end);
    leg.q = motion.q();
    leg.p = motion.p();
    leg.steps = motion.steps();
    leg.cpu_seconds = thread_seconds() - before;
    return leg;
  };
  return run_legs(work.scene, work.times, static_cast<long>(work.leg_digits.size()), work.keeper, run);
}

}  // namespace

RouteRun taylor_route(const RouteWork& work) {
  const Leg way =
      way_by(work, [&](const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& p, const Mpfr&,
                       const double& done) { return TaylorMotion(problem, q, p, [&] { work.progress(done); }); });
  const auto order = [](unsigned digits) {
    const PrecisionScope scope(digits);
    return TaylorMotion::order_for(significand_bits<Mpfr>());
  };
  return {fmt::format("Taylor series of order {}, {} steps, {} digits",
                      range_text(order(work.leg_digits.front()), order(work.leg_digits.back())), way.steps,
                      digits_text(work.leg_digits)),
          way.cpu_seconds, way.points};
}

int stages_of_route(double digits) {
  // As a step takes s^2 to s^3 operations, nine stages for twenty digits are the best (measured from 30 to 150 digits).
  constexpr int least_stages = 4;
  return std::clamp(static_cast<int>(std::lround(9 * digits / 20)), least_stages, max_s);
}

RouteRun hbvm_route(const RouteWork& work, double spare) {
  std::optional<Hbvm<Mpfr>> method;
  const Leg way = way_by(work, [&](const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& p,
                                   const Mpfr& length, const double&) {
    const double digits = digits10<Mpfr>() - spare;
    const int s = stages_of_route(digits);
    method.emplace(make_hbvm<Mpfr>(s, s));
    return HbvmMotion(problem, *method, q, p, digits, length);
  });
  const std::string first = std::to_string(stages_of_route(work.leg_digits.front() - spare)),
                    last = std::to_string(stages_of_route(work.leg_digits.back() - spare));
  return {
      fmt::format("HBVM({0},{0}){1}, {2} steps, {3} digits", first,
                  first == last ? "" : fmt::format(" to HBVM({0},{0})", last), way.steps, digits_text(work.leg_digits)),
      way.cpu_seconds, way.points};
}

std::optional<RouteRun> closed_form_route(const RouteWork& work) {
  const double before = thread_seconds();
  const std::unique_ptr<ClosedForm> motion = closed_form_of(work.scene);
  if (!motion) return std::nullopt;
  RouteRun run;
  for (const Mpfr& t : work.times) {
    run.points.push_back(motion->at(t));
    work.progress(approximately(Mpfr(t / work.times.back())));
  }
  run.settings = fmt::format("closed form: {}, {} digits", motion->name(), motion->working_digits());
  run.cpu_seconds = thread_seconds() - before;
  return run;
}

namespace {

/// The greatest of the sizes by which a start is changed.
struct StartScales {
  Mpfr q = 0, p = 0;
};

/// The start, changed by some parts of what it consists of, vector by vector in space. A position also consists of the
/// way in so long a time, and a momentum of what each force does to it.
StartScales change_start(const Assembled<Mpfr>& scene, const Mpfr& parts, const Mpfr& time, Vector<Mpfr>& q,
                         Vector<Mpfr>& p) {
  StartScales greatest;
  const Index d = scene.problem.dimension;
  StateEvaluator<Mpfr> point(scene.problem);
  const StateEvaluator<Mpfr>::Forces forces = point.forces(scene.q0, scene.p0);
  Vector<Mpfr> v(q.size());
  scene.problem.mass.velocity(lanes(scene.p0), lanes(v));
  for (const SpaceBlock& block : scene.problem.blocks) {
    Mpfr place = 0, momentum = 0;
    for (Index j = block.offset; j < block.offset + d; ++j) {
      raise_to(place, magnitude(scene.q0[j]));
      raise_to(place, magnitude(Mpfr(time * v[j])));
      raise_to(momentum, magnitude(scene.p0[j]));
      raise_to(momentum, magnitude(Mpfr(time * forces.applied[j])));
      raise_to(momentum, magnitude(Mpfr(time * forces.constraint[j])));
    }
    // Changes of both signs, of which no symmetry of a scene is left.
    for (Index j = block.offset; j < block.offset + d; ++j) {
      q[j] += parts * place * (j % 3 - 1);
      p[j] += parts * momentum * (1 + j % 5) / (j % 2 == 0 ? 5 : -5);
    }
    raise_to(greatest.q, place);
    raise_to(greatest.p, momentum);
  }
  return greatest;
}

}  // namespace

MotionNature nature_of(const Scene& scene, const std::vector<Expression>& times, const RouteProgress& progress) {
  // A change that grows to a thousandth of what the start consists of tells its rate. From there on it is taken to grow
  // like that. Digits are lost of what there is, which may be less: of the momentum of a body that is nearly at rest.
  constexpr double lost = -3;
  constexpr int change = 15, pieces = 64;
  constexpr unsigned digits = 2 * change;
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  const Mpfr end = evaluate<Mpfr>(times.back(), scene.constants);
  TaylorMotion motion(assembled.problem, assembled.q0, assembled.p0, [&] { progress(0); });
  Mpfr radius = 1;
  mpfr_mul_2si(raw(radius), raw(radius), std::lround(motion.least_radius()), MPFR_RNDN);
  Vector<Mpfr> q0 = assembled.q0, p0 = assembled.p0;
  const StartScales scales =
      change_start(assembled, literal<Mpfr>("1e-" + std::to_string(change)), std::min(end, radius), q0, p0);
  // The change is seen in the digits that it has: rounding grows as it does.
  constexpr unsigned seen = change + 8;
  const auto in_fewer = [](auto&& make) {
    const PrecisionScope fewer(seen);
    return make();
  };
  const Assembled<Mpfr> scene_of_other = in_fewer([&] { return assemble<Mpfr>(scene); });
  TaylorMotion other =
      in_fewer([&] { return TaylorMotion(scene_of_other.problem, rounded<Mpfr>(q0), rounded<Mpfr>(p0)); });
  double worst = -change, most_grown = -change, times_longer = 1;
  std::vector<double> grown;  // until the end of each piece
  for (int piece = 1; piece <= pieces && most_grown <= lost; ++piece) {
    const Mpfr t = end * piece / pieces;
    const auto walked = [&](const Mpfr& now) { progress(approximately(Mpfr(now / end))); };
    motion.advance_to(t, walked);
    in_fewer([&] { other.advance_to(rounded_to<Mpfr>(raw(t)), walked); });
    const auto look = [&](const Vector<Mpfr>& all, const Vector<Mpfr>& all_changed, const Mpfr& scale) {
      const Index bodies = assembled.problem.mass.of_bodies();
      const Vector<Mpfr> x = all.head(bodies), changed = all_changed.head(bodies);
      const Mpfr size = max_norm(x), difference = distance(x, changed);
      if (size == 0 || difference == 0) return;
      worst = std::max(worst, (log2_of(difference) - log2_of(size)) / std::log2(double{10}));
      const double now = (log2_of(difference) - log2_of(std::max(size, scale))) / std::log2(double{10});
      most_grown = std::max(most_grown, now);
      grown.back() = std::max(grown.back(), now + change);
    };
    grown.push_back(0);
    look(motion.q(), other.q(), scales.q);
    look(motion.p(), other.p(), scales.p);
    times_longer = static_cast<double>(pieces) / piece;
  }
  const double rate = (most_grown + change) / static_cast<double>(grown.size());
  const double digits_lost = std::max(double{0}, worst + change + (most_grown + change) * (times_longer - 1));
  while (static_cast<int>(grown.size()) < pieces) grown.push_back(grown.back() + rate);
  return {digits_lost, motion.least_radius(), static_cast<double>(motion.steps() + 1) * times_longer, grown};
}

double MotionNature::lost_by(double part) const {
  const auto pieces = static_cast<std::size_t>(part * static_cast<double>(grown.size()));
  double most = 0;
  for (std::size_t n = 0; n < std::min(pieces, grown.size()); ++n) most = std::max(most, grown[n]);
  return grown.empty() ? digits_lost : most;
}

double MotionNature::to_come(double part) const {
  const auto pieces = static_cast<std::size_t>(part * static_cast<double>(grown.size()));
  if (pieces == 0) return digits_lost;
  // It grows by no more than what an earlier one grows by from its least on.
  double least = digits_lost;
  for (std::size_t n = std::min(pieces, grown.size()) - 1; n < grown.size(); ++n) least = std::min(least, grown[n]);
  return std::max(double{0}, digits_lost - std::max(double{0}, least));
}

long MotionNature::legs() const {
  // A leg's start takes a step more: half a percent.
  constexpr double steps_of_leg = 200;
  return std::max(1L, static_cast<long>(std::ceil(steps / steps_of_leg)));
}

}  // namespace hbvm::core
