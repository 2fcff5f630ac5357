#include "hbvm/reference/route_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hbvm/clock.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/reference/taylor.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/step/hbvm_stepper.hpp"

namespace hbvm {
namespace {

unsigned working_digits() { return static_cast<unsigned>(digits10<Mpfr>()); }

/// A double as it is.
Mpfr exact(double x) {
  Mpfr result = 0;
  mpfr_set_d(raw(result), x, MPFR_RNDN);
  return result;
}

/// Lengths of the steps of a Taylor series, which are in proportion to its radii, as parts of few different steps. One
/// that is a little longer is not worth a part of its own.
std::vector<Calm> calm_parts(const std::vector<std::pair<double, double>>& steps) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [until, log2_length] : steps) least = std::min(least, log2_length);
  std::vector<Calm> parts;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    // Of a step and its neighbours: the steps of the other route end elsewhere.
    double length = steps[n].second;
    if (n > 0) length = std::min(length, steps[n - 1].second);
    if (n + 1 < steps.size()) length = std::min(length, steps[n + 1].second);
    const int doublings = static_cast<int>(std::floor(length - least)) / 2 * 2;
    if (!parts.empty() && parts.back().doublings == doublings)
      parts.back().until = steps[n].first;
    else
      parts.push_back({steps[n].first, doublings});
  }
  return parts;
}

std::string hbvm_name(int s) { return "HBVM(" + std::to_string(s) + "," + std::to_string(s) + ")"; }

/// 2^x, rounded to double.
Mpfr power_of(double log2) {
  Mpfr x = 0;
  mpfr_set_d(raw(x), std::exp2(log2 - std::floor(log2)), MPFR_RNDN);
  mpfr_mul_2si(raw(x), raw(x), static_cast<long>(std::floor(log2)), MPFR_RNDN);
  return x;
}

}  // namespace

RouteRun taylor_route(const RouteWork& work) {
  Index order = 0;
  const Leg way = run_legs(work.scene, work.times, work.legs, work.keeper,
                           [&](const Mpfr& begin, const Mpfr& end, const std::vector<Mpfr>& times,
                               const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
                             const double before = thread_seconds();
                             TaylorMotion motion(work.scene.problem, q, p);
                             const auto advance_to = [&](const Mpfr& t) {
                               motion.advance_to(t - begin, [&](const Mpfr& now) {
                                 work.progress(approximately(Mpfr((begin + now) / work.times.back())));
                               });
                             };
                             Leg leg;
                             for (const Mpfr& t : times) {
                               advance_to(t);
                               leg.points.push_back({motion.q(), motion.p(), motion.lambda()});
                             }
                             advance_to(end);
                             leg.q = motion.q();
                             leg.p = motion.p();
                             leg.steps = motion.steps();
                             order = motion.order();
                             leg.cpu_seconds = thread_seconds() - before;
                             return leg;
                           });
  if (order == 0) order = TaylorMotion(work.scene.problem, work.scene.q0, work.scene.p0).order();
  return {fmt::format("Taylor series of order {}, {} steps, {} digits", order, way.steps, working_digits()),
          way.cpu_seconds, way.points};
}

namespace {

/// HBVM with steps of a length that doubles where the motion is calm.
class HbvmLeg {
 public:
  HbvmLeg(const RouteWork& work, const Hbvm<Mpfr>& method, const MotionNature& nature)
      : work_(work), method_(method), nature_(nature), point_(work.scene.problem) {}

  /// \throws StageFailure, IntegrationError
  Leg run(const Mpfr& longest, const Mpfr& begin, const Mpfr& end, const std::vector<Mpfr>& times,
          const Vector<Mpfr>& q, const Vector<Mpfr>& p) const {
    HbvmStepper<Mpfr> stepper(work_.scene.problem, method_, SolverKind::automatic);
    State<Mpfr> state(q, p);
    Mpfr now = begin;
    Leg leg;
    auto part = nature_.calm.begin();
    const auto advance_to = [&](const Mpfr& t) {
      while (now < t) {
        // Until the time, or where the steps change before it.
        Mpfr until = t;
        int doublings = 0;
        if (part != nature_.calm.end()) {
          doublings = part->doublings;
          const Mpfr change = exact(part->until);
          if (change <= t) ++part;
          if (change <= now) continue;
          until = std::min(until, change);
        }
        leg.steps += take_steps(stepper, state, now, until, longest, doublings);
        now = until;
      }
    };
    for (const Mpfr& t : times) {
      advance_to(t);
      const Vector<Mpfr> tangential = point_.tangential(state.q, state.p);
      leg.points.push_back({state.q, tangential, point_.multiplier(state.q, tangential)});
    }
    advance_to(end);
    leg.q = state.q;
    leg.p = state.p;
    return leg;
  }

 private:
  long take_steps(HbvmStepper<Mpfr>& stepper, State<Mpfr>& state, const Mpfr& from, const Mpfr& to, const Mpfr& longest,
                  int doublings) const {
    const Mpfr interval = to - from;
    Mpfr length = longest;
    mpfr_mul_2si(raw(length), raw(length), doublings, MPFR_RNDN);
    const double count = std::ceil(approximately(Mpfr(interval / length)));
    constexpr long most_steps = 1'000'000'000;
    if (!(count < static_cast<double>(most_steps)))
      throw IntegrationError(hbvm_name(method_.s) + " would take more than 1e9 steps");
    const long n = std::max(1L, static_cast<long>(count));
    const Mpfr h = interval / n;
    for (long i = 0; i < n; ++i) {
      stepper.step(state, h);
      work_.progress(approximately(Mpfr((from + h * (i + 1)) / work_.times.back())));
    }
    return n;
  }

  const RouteWork& work_;
  const Hbvm<Mpfr>& method_;
  const MotionNature& nature_;
  mutable Point<Mpfr> point_;
};

}  // namespace

RouteRun hbvm_route(const RouteWork& work, double digits, const MotionNature& nature) {
  // With a singularity at the distance R the coefficients of a step fall by 4 R/h each, errors of the output state by
  // its square a stage. As a step takes s^2 to s^3 operations, nine stages for twenty digits are the best (measured
  // from 30 to 150 digits); a fifth of the step is left for what the radius of a series at low precision does not show.
  constexpr int least_stages = 4;
  const int s = std::clamp(static_cast<int>(std::lround(9 * digits / 20)), least_stages, max_s);
  const double log2_step = nature.log2_radius + std::log2(double{16} / 5) - digits * std::log2(double{10}) / (2 * s);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
  const HbvmLeg steps(work, method, nature);
  const Leg way = run_legs(work.scene, work.times, work.legs, work.keeper,
                           [&](const Mpfr& begin, const Mpfr& end, const std::vector<Mpfr>& times,
                               const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
                             const double before = thread_seconds();
                             constexpr int most_halvings = 6;
                             for (int halvings = 0;; ++halvings) try {
                                 Leg leg = steps.run(power_of(log2_step - halvings), begin, end, times, q, p);
                                 leg.cpu_seconds = thread_seconds() - before;
                                 return leg;
                               } catch (const StageFailure& failure) {
                                 if (halvings == most_halvings)
                                   throw IntegrationError(hbvm_name(s) + " finds no solution after t = " +
                                                          to_scientific(begin, 6) + ": " + failure.what());
                               }
                           });
  return {fmt::format("{}, {} steps from {} on, {} digits", hbvm_name(s), way.steps,
                      to_scientific(power_of(log2_step), 3), working_digits()),
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

MotionNature nature_of(const Scene& scene, const std::vector<Expression>& times, const RouteProgress& progress) {
  // A change that grows to a thousandth of what it changes tells its rate: from there on it is taken to grow like that.
  constexpr double lost = -3;
  constexpr int change = 15, pieces = 64;
  constexpr unsigned digits = 2 * change;
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  const Mpfr delta = literal<Mpfr>("1e-" + std::to_string(change));
  Vector<Mpfr> q0 = assembled.q0, p0 = assembled.p0;
  for (Index j = 0; j < q0.size(); ++j) {
    // Changes of both signs, of which no symmetry of a scene is left.
    q0[j] += delta * max_norm(assembled.q0) * (j % 3 - 1);
    p0[j] += delta * max_norm(assembled.p0) * (1 + j % 5) / (j % 2 == 0 ? 5 : -5);
  }
  TaylorMotion motion(assembled.problem, assembled.q0, assembled.p0), other(assembled.problem, q0, p0);
  const Mpfr end = evaluate<Mpfr>(times.back(), scene.constants);
  double worst = -change, times_longer = 1;
  std::vector<std::pair<double, double>> lengths;
  Mpfr last = 0;
  for (int piece = 1; piece <= pieces && worst <= lost; ++piece) {
    const Mpfr t = end * piece / pieces;
    motion.advance_to(t, [&](const Mpfr& now) {
      lengths.emplace_back(approximately(now), log2_of(Mpfr(now - last)));
      last = now;
      progress(0);
    });
    other.advance_to(t, [&](const Mpfr&) { progress(0); });
    for (const auto vector : {&TaylorMotion::q, &TaylorMotion::p}) {
      const Mpfr size = max_norm((motion.*vector)());
      if (size > 0)
        worst = std::max(
            worst, (log2_of(distance((motion.*vector)(), (other.*vector)())) - log2_of(size)) / std::log2(double{10}));
    }
    times_longer = static_cast<double>(pieces) / piece;
  }
  // The last step ends where the motion does: its own length is not known.
  if (worst <= lost && !lengths.empty()) lengths.emplace_back(approximately(end), lengths.back().second - 1);
  // A leg's start takes a step more: half a percent.
  constexpr double steps_of_leg = 200;
  const auto legs = static_cast<long>(std::ceil(static_cast<double>(lengths.size()) * times_longer / steps_of_leg));
  return {std::max(double{0}, (worst + change) * times_longer), motion.least_radius(), calm_parts(lengths),
          std::max(1L, legs)};
}

}  // namespace hbvm
