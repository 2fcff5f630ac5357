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

/// 2^x, rounded to double.
Mpfr power_of(double log2) {
  Mpfr x = 0;
  mpfr_set_d(raw(x), std::exp2(log2 - std::floor(log2)), MPFR_RNDN);
  mpfr_mul_2si(raw(x), raw(x), static_cast<long>(std::floor(log2)), MPFR_RNDN);
  return x;
}

}  // namespace

RouteRun taylor_route(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times, const RouteProgress& progress) {
  const double before = thread_seconds();
  RouteRun run;
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  const Mpfr& end = times.back();
  for (const Mpfr& t : times) {
    motion.advance_to(t, [&](const Mpfr& now) { progress(approximately(Mpfr(now / end))); });
    run.points.push_back({motion.q(), motion.p(), motion.lambda()});
  }
  run.settings =
      fmt::format("Taylor series of order {}, {} steps, {} digits", motion.order(), motion.steps(), working_digits());
  run.cpu_seconds = thread_seconds() - before;
  return run;
}

RouteRun hbvm_route(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times, double digits,
                    const MotionNature& nature, const RouteProgress& progress) {
  const double before = thread_seconds();
  // With a singularity at the distance R the coefficients of a step fall by 4 R/h each, errors of the output state by
  // its square a stage. As a step takes s^2 to s^3 operations, nine stages for twenty digits are the best (measured
  // from 30 to 150 digits); a fifth of the step is left for what the radius of a series at low precision does not show.
  constexpr int least_stages = 4;
  const int s = std::clamp(static_cast<int>(std::lround(9 * digits / 20)), least_stages, max_s);
  double log2_step = nature.log2_radius + std::log2(double{16} / 5) - digits * std::log2(double{10}) / (2 * s);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
  const Problem<Mpfr>& problem = scene.problem;
  Point<Mpfr> point(problem);
  constexpr int most_halvings = 6;
  for (int halvings = 0;; ++halvings, log2_step -= 1) {
    RouteRun run;
    const Mpfr longest = power_of(log2_step);
    HbvmStepper<Mpfr> stepper(problem, method, SolverKind::automatic);
    State<Mpfr> state(scene.q0, scene.p0);
    Mpfr now = 0;
    long steps = 0;
    try {
      auto part = nature.calm.begin();
      for (const Mpfr& t : times) {
        while (now < t) {
          // Until the time, or where the steps change before it.
          Mpfr end = t;
          int doublings = 0;
          if (part != nature.calm.end()) {
            doublings = part->doublings;
            const Mpfr change = exact(part->until);
            if (change <= t) ++part;
            if (change <= now) continue;
            end = std::min(end, change);
          }
          const Mpfr interval = end - now;
          Mpfr length = longest;
          mpfr_mul_2si(raw(length), raw(length), doublings, MPFR_RNDN);
          const double count = std::ceil(approximately(Mpfr(interval / length)));
          constexpr long most_steps = 1'000'000'000;
          if (!(count < static_cast<double>(most_steps)))
            throw IntegrationError("HBVM(" + std::to_string(s) + "," + std::to_string(s) +
                                   ") would take more than 1e9 steps");
          const long n = std::max(1L, static_cast<long>(count));
          const Mpfr h = interval / n;
          for (long i = 0; i < n; ++i) {
            stepper.step(state, h);
            progress(approximately(Mpfr((now + h * (i + 1)) / times.back())));
          }
          steps += n;
          now = end;
        }
        const Vector<Mpfr> p = point.tangential(state.q, state.p);
        run.points.push_back({state.q, p, point.multiplier(state.q, p)});
      }
    } catch (const StageFailure& failure) {
      if (halvings == most_halvings)
        throw IntegrationError("HBVM(" + std::to_string(s) + "," + std::to_string(s) +
                               ") finds no solution after t = " + to_scientific(now, 6) + ": " + failure.what());
      continue;
    }
    run.settings = fmt::format("HBVM({},{}), {} steps from {} on, {} digits", s, s, steps, to_scientific(longest, 3),
                               working_digits());
    run.cpu_seconds = thread_seconds() - before;
    return run;
  }
}

std::optional<RouteRun> closed_form_route(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times,
                                          const RouteProgress& progress) {
  const double before = thread_seconds();
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  if (!motion) return std::nullopt;
  RouteRun run;
  for (const Mpfr& t : times) {
    run.points.push_back(motion->at(t));
    progress(approximately(Mpfr(t / times.back())));
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
  return {std::max(double{0}, (worst + change) * times_longer), motion.least_radius(), calm_parts(lengths)};
}

}  // namespace hbvm
