#include "reference/proved_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clock.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/agreement.hpp"
#include "reference/growth_survey.hpp"
#include "reference/observed_texts.hpp"
#include "reference/proved_motion.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

Mpfr centre_of(const RealBall& x) {
  Mpfr centre;
  arf_get_mpfr(raw(centre), arb_midref(raw(x)), MPFR_RNDN);
  return centre;
}

Vector<Mpfr> centres(const std::vector<RealBall>& x) {
  Vector<Mpfr> result(static_cast<Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) result[static_cast<Index>(i)] = centre_of(x[i]);
  return result;
}

/// The greatest radius, and what rounding a centre to the digits of the scope adds.
Mpfr radius_of(const std::vector<RealBall>& x) {
  Mpfr radius = 0;
  for (const RealBall& component : x) {
    const RealBall off = greatest_magnitude(component - exact_ball(raw(centre_of(component))));
    Mpfr of_component;
    arf_get_mpfr(raw(of_component), arb_midref(raw(off)), MPFR_RNDU);
    raise_to(radius, of_component);
  }
  return radius;
}

std::string upper_text(const Mpfr& radius) {
  // Three digits, rounded up.
  Mpfr more = radius;
  mpfr_mul_d(raw(more), raw(more), 1 + double{1} / 64, MPFR_RNDU);
  return radius == 0 ? "0" : to_scientific(more, 2);
}

/// The states of a proof, in the digits of the scope, and how.
struct Proof {
  Assembled<Mpfr> scene;
  std::vector<ProvedState> states;
  NamedRun run{"proof", {}};  ///< the centres
};

/// By how many digits a radius is greater than a hundredth of a unit of the last digit; at most 0 if it is not.
double missing_digits(const Vector<Mpfr>& x, const Mpfr& radius, const Mpfr& natural, int digits) {
  using std::log10, std::floor;
  Mpfr size = max_norm(x);
  if (size <= radius) size = natural;
  if (size == 0 || radius == 0) return 0;
  constexpr int hundredth = 2;
  return approximately(Mpfr(log10(radius) - floor(log10(size)))) + digits + hundredth;
}

/// The most of all vectors and times. What vanishes is measured by what it is at other times, and H by its terms.
double missing_digits(const Proof& proof, int digits) {
  StateEvaluator<Mpfr> point(proof.scene.problem);
  Mpfr q = 0, p = 0, lambda = 0, H = 0;
  for (const ExactPoint& at : proof.run.run.points) {
    raise_to(q, max_norm(at.q));
    raise_to(p, max_norm(at.p));
    raise_to(lambda, max_norm(at.lambda));
    raise_to(H, point.energy_size(at.q, at.p));
  }
  double missing = 0;
  for (std::size_t n = 0; n < proof.states.size(); ++n) {
    const ProvedState& state = proof.states[n];
    const ExactPoint& at = proof.run.run.points[n];
    const std::vector<RealBall> energy{state.H};
    missing = std::max({missing, missing_digits(at.q, radius_of(state.q), q, digits),
                        missing_digits(at.p, radius_of(state.p), p, digits),
                        missing_digits(at.lambda, radius_of(state.lambda), lambda, digits),
                        missing_digits(centres(energy), radius_of(energy), H, digits)});
  }
  return missing;
}

/// \throws InputError for a start that is not exact
Proof prove(const ReferenceRequest& request, const GrowthSurvey& survey, const std::function<void(double)>& progress) {
  const double before = thread_seconds();
  const Constants& constants = request.scene.constants;
  const auto digits = static_cast<unsigned>(digits10<Mpfr>());
  const PrecisionScope scope(digits);
  const auto with_twice = [&](const auto& work) {
    const PrecisionScope twice(2 * digits + 20);
    return work();
  };
  const Assembled<Mpfr> exact = with_twice([&] { return assemble<Mpfr>(request.scene); });
  if (!exact.settled.empty())
    throw InputError("the start of '" + request.scene.name + "' is " + exact.settled +
                     ": there is no exact start of which to prove anything; write its numbers exactly, as sqrt(1/2)");
  Proof proof{assemble<Mpfr>(request.scene), {}};
  const Mpfr last = evaluate<Mpfr>(request.times.back(), constants);
  double done = 0;
  ProvedMotion motion(
      exact, proof.scene, last, [&](double t) { return survey.omega_at(t); }, [&] { progress(done); });
  for (const Expression& time : request.times) {
    const RealBall t = with_twice([&] { return believed(evaluate<Mpfr>(time, constants)); });
    proof.states.push_back(motion.at(t, [&](double now) { done = now / approximately(last); }));
    const ProvedState& state = proof.states.back();
    proof.run.run.points.push_back({centres(state.q), centres(state.p), centres(state.lambda)});
  }
  proof.run.run.settings = fmt::format("order {}, {} steps, {} digits, errors bounded to grow by 10^{:.1f}",
                                       motion.order(), motion.steps(), digits, motion.growth() / std::numbers::ln10);
  proof.run.run.cpu_seconds = thread_seconds() - before;
  return proof;
}

/// States in the bounds: the centres, and some at both ends of them.
std::vector<std::vector<ExactPoint>> states_within(const Proof& proof) {
  std::vector<std::vector<ExactPoint>> result{proof.run.run.points};
  for (const int sign : {1, -1}) {
    result.push_back(proof.run.run.points);
    for (std::size_t n = 0; n < proof.states.size(); ++n) {
      ExactPoint& at = result.back()[n];
      const Mpfr of_q = radius_of(proof.states[n].q) * sign, of_p = radius_of(proof.states[n].p) * sign;
      for (Index j = 0; j < at.q.size(); ++j) {
        at.q[j] += j % 2 == 0 ? of_q : Mpfr(-of_q);
        at.p[j] += j % 2 == 0 ? Mpfr(-of_p) : of_p;
      }
    }
  }
  return result;
}

void add_to(Reference& reference, const ReferenceRequest& request, const Proof& proof, const Agreement& agreement) {
  reference.times = agreement.states();
  reference.momentum_names = agreement.momentum_names();
  reference.lambda_names = names_of_constraints(proof.scene.problem);
  add_observed_texts(reference, request, proof.scene.problem, states_within(proof));
  for (std::size_t n = 0; n < proof.states.size(); ++n) {
    const ProvedState& state = proof.states[n];
    reference.times[n].radius = {upper_text(radius_of(state.q)), upper_text(radius_of(state.p)),
                                 upper_text(radius_of(state.lambda)), upper_text(radius_of({state.H}))};
  }
  reference.routes.push_back({proof.run.name, proof.run.run.settings, proof.run.run.cpu_seconds});
  reference.proved = request.digits;
}

}  // namespace

void add_proved_states(Reference& reference, const ReferenceRequest& request) {
  constexpr double part_of_survey = double{1} / 10;
  const auto progress = [&](double part) {
    if (request.progress) request.progress(std::min(double{1}, part));
  };
  const GrowthSurvey survey =
      survey_growth(request.scene, request.times.back(), [&](double part) { progress(part_of_survey * part); });
  constexpr int guard = 14, attempts = 6;
  constexpr double most = 50'000;
  double digits = request.digits + std::ceil(survey.growth + std::log10(survey.steps + 1)) + guard;
  for (int attempt = 1;; ++attempt) {
    if (!(digits < most) && !request.force)
      throw InputError(
          fmt::format("bounds of errors grow by a factor of 10^{:.0f} until t = {}: a proof takes {:.0f} "
                      "digits; ask for a shorter time, or say --force",
                      survey.growth, request.times.back().text(), digits));
    const PrecisionScope scope(static_cast<unsigned>(digits));
    try {
      const Proof proof =
          prove(request, survey, [&](double part) { progress(part_of_survey + (1 - part_of_survey) * part); });
      // What is conserved has the digits of the start, too.
      const Agreement agreement(proof.scene, request.times, {proof.run}, request.digits);
      double missing = missing_digits(proof, request.digits);
      if (!agreement.holds()) missing = std::max(missing, static_cast<double>(request.digits + 1 - agreement.digits()));
      if (missing <= 0) return add_to(reference, request, proof, agreement);
      if (attempt == attempts) {
        agreement.require();
        throw IntegrationError(fmt::format("with {:.0f} digits, {:.0f} are missing to prove {}", digits,
                                           std::ceil(missing), request.digits));
      }
      digits += std::ceil(missing) + 2;
    } catch (const BoundsTooWide&) {
      if (attempt == attempts) throw;
      digits += std::ceil(digits / 2);
    }
  }
}

}  // namespace hbvm::core
