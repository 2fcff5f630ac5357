#include "hbvm/reference/route_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

RouteRun hbvm_route(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times, double digits, double log2_radius,
                    const RouteProgress& progress) {
  const double before = thread_seconds();
  // With a singularity at the distance R the coefficients of a step fall by 4 R/h each, errors of the output state by
  // its square a stage. As a step takes s^2 to s^3 operations, nine stages for twenty digits are the best (measured
  // from 30 to 150 digits); a fifth of the step is left for what the radius of a series at low precision does not show.
  constexpr int least_stages = 4;
  const int s = std::clamp(static_cast<int>(std::lround(9 * digits / 20)), least_stages, max_s);
  double log2_step = log2_radius + std::log2(double{16} / 5) - digits * std::log2(double{10}) / (2 * s);
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
      for (const Mpfr& t : times) {
        const Mpfr interval = t - now;
        const double count = std::ceil(approximately(Mpfr(interval / longest)));
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
        now = t;
        const Vector<Mpfr> p = point.tangential(state.q, state.p);
        run.points.push_back({state.q, p, point.multiplier(state.q, p)});
      }
    } catch (const StageFailure& failure) {
      if (halvings == most_halvings)
        throw IntegrationError("HBVM(" + std::to_string(s) + "," + std::to_string(s) +
                               ") finds no solution after t = " + to_scientific(now, 6) + ": " + failure.what());
      continue;
    }
    run.settings = fmt::format("HBVM({},{}), {} steps of at most {}, {} digits", s, s, steps, to_scientific(longest, 3),
                               working_digits());
    run.cpu_seconds = thread_seconds() - before;
    return run;
  }
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
  for (int piece = 1; piece <= pieces && worst <= lost; ++piece) {
    const Mpfr t = end * piece / pieces;
    const auto after_step = [&](const Mpfr&) { progress(0); };
    motion.advance_to(t, after_step);
    other.advance_to(t, after_step);
    for (const auto vector : {&TaylorMotion::q, &TaylorMotion::p}) {
      const Mpfr size = max_norm((motion.*vector)());
      if (size > 0)
        worst = std::max(
            worst, (log2_of(distance((motion.*vector)(), (other.*vector)())) - log2_of(size)) / std::log2(double{10}));
    }
    times_longer = static_cast<double>(pieces) / piece;
  }
  return {std::max(double{0}, (worst + change) * times_longer), motion.least_radius()};
}

}  // namespace hbvm
