#include "reference/usual_step.hpp"

#include <algorithm>
#include <cmath>

#include "hbvm/error.hpp"
#include "integrate/time_grid.hpp"
#include "reference/taylor.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

constexpr int divisor = 8;

/// log2 of the least radius of convergence in the first steps. Where the motion has no singularity it is that of a
/// series of few terms, so that a period has steps enough.
double log2_radius(const Scene& scene, const Mpfr& until) {
  struct Enough {};
  constexpr long most_steps = 50;
  constexpr unsigned digits = 8;
  constexpr double much_shorter = 12;
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  TaylorMotion motion(assembled.problem, assembled.q0, assembled.p0);
  const double at_start = motion.least_radius();
  try {
    motion.advance_to(until, [&](const Mpfr& t) {
      if (motion.least_radius() < at_start - much_shorter)
        throw IntegrationError("the motion comes too near a singularity at t = " + to_scientific(t, 4));
      if (motion.steps() >= most_steps) throw Enough();
    });
  } catch (const Enough&) {
  }
  return motion.least_radius();
}

/// "1/32", or "8".
std::string power_of_two(int exponent) {
  const std::string power = std::to_string(1LL << std::abs(exponent));
  return exponent < 0 ? "1/" + power : power;
}

}  // namespace

Expression usual_step(const Scene& scene, const Expression& until) {
  constexpr unsigned digits = 20;
  const PrecisionScope scope(digits);
  const Mpfr end = TimeGrid<Mpfr>(until, until, scene.constants).until();
  const double log2_end = log2_of(end);
  const double longest = [&] {
    try {
      return log2_radius(scene, end) - std::log2(double{divisor});
    } catch (const IntegrationError& error) {
      throw InputError("no step is given, and the scene's time scale shows none: " + std::string(error.what()) +
                       "; say how long a step is to be");
    }
  }();
  constexpr int most = 40;
  const int exponent = static_cast<int>(std::floor(std::clamp(longest, -double{most}, double{most})));
  for (int e = std::min(exponent, static_cast<int>(std::floor(log2_end))); e >= -most && e > exponent - most; --e) {
    const Mpfr steps = ldexp(end, -e);
    if (steps == floor(steps)) return Expression::parse(power_of_two(e));
    if (e < exponent - divisor) break;
  }
  const int halvings = std::max(0, static_cast<int>(std::ceil(log2_end - longest)));
  if (halvings == 0) return until;
  return Expression::parse("(" + until.text() + ")/2^" + std::to_string(halvings));
}

}  // namespace hbvm::core
