#include "reference/proved_states.hpp"

#include <algorithm>
#include <cmath>

#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/observed_texts.hpp"
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

/// By how many digits a radius is greater than a hundredth of a unit of the last digit; at most 0 if it is not.
double of_vector(const Vector<Mpfr>& x, const Mpfr& radius, const Mpfr& natural, int digits) {
  using std::log10, std::floor;
  Mpfr size = max_norm(x);
  if (size <= radius) size = natural;
  if (size == 0 || radius == 0) return 0;
  constexpr int hundredth = 2;
  return approximately(Mpfr(log10(radius) - floor(log10(size)))) + digits + hundredth;
}

/// States in the bounds: the centres, and some at both ends of them.
std::vector<std::vector<ExactPoint>> states_within(const ProvedStates& proof) {
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

unsigned more_than_twice() { return 2 * static_cast<unsigned>(digits10<Mpfr>()) + 20; }

}  // namespace

Assembled<Mpfr> assembled_for_proof(const Scene& scene) {
  const PrecisionScope more(more_than_twice());
  Assembled<Mpfr> exact = assemble<Mpfr>(scene);
  if (!exact.settled.empty())
    throw InputError("the start of '" + scene.name + "' is " + exact.settled +
                     ": there is no exact start of which to prove anything; write its numbers exactly, as sqrt(1/2)");
  return exact;
}

RealBall time_for_proof(const Expression& time, const Constants& constants) {
  const PrecisionScope more(more_than_twice());
  return believed(evaluate<Mpfr>(time, constants));
}

ProvedStates::ProvedStates(const Scene& of) : scene(assemble<Mpfr>(of)) {}

void ProvedStates::add(const ProvedState& state) {
  states.push_back(state);
  run.run.points.push_back({centres(state.q), centres(state.p), centres(state.lambda)});
}

double ProvedStates::missing_digits(int digits) const {
  StateEvaluator<Mpfr> point(scene.problem);
  Mpfr q = 0, p = 0, lambda = 0, H = 0;
  for (const ExactPoint& at : run.run.points) {
    raise_to(q, max_norm(at.q));
    raise_to(p, max_norm(at.p));
    raise_to(lambda, max_norm(at.lambda));
    raise_to(H, point.energy_size(at.q, at.p));
  }
  double missing = 0;
  for (std::size_t n = 0; n < states.size(); ++n) {
    const ProvedState& state = states[n];
    const ExactPoint& at = run.run.points[n];
    const std::vector<RealBall> energy{state.H};
    missing = std::max({missing, of_vector(at.q, radius_of(state.q), q, digits),
                        of_vector(at.p, radius_of(state.p), p, digits),
                        of_vector(at.lambda, radius_of(state.lambda), lambda, digits),
                        of_vector(centres(energy), radius_of(energy), H, digits)});
  }
  return missing;
}

void ProvedStates::write(Reference& reference, const ReferenceRequest& request, const Agreement& agreement) const {
  reference.times = agreement.states();
  reference.momentum_names = agreement.momentum_names();
  reference.lambda_names = names_of_constraints(scene.problem);
  add_observed_texts(reference, request, scene.problem, states_within(*this));
  for (std::size_t n = 0; n < states.size(); ++n) {
    const ProvedState& state = states[n];
    reference.times[n].radius = {upper_text(radius_of(state.q)), upper_text(radius_of(state.p)),
                                 upper_text(radius_of(state.lambda)), upper_text(radius_of({state.H}))};
  }
  reference.routes.push_back({run.name, run.run.settings, run.run.cpu_seconds});
  reference.proved = request.digits;
}

}  // namespace hbvm::core
