#include <algorithm>

#include "hbvm/error.hpp"
#include "measurements.hpp"
#include "problem/constraint.hpp"
#include "step/hbvm_method.hpp"
#include "trial.hpp"

namespace hbvm::core {
namespace {

/// The derivative of order `order` of q at the start of a step, from the polynomial u with u' = M^-1 sum_j P_j gamma_j.
/// On [0, 1] P_j^(r)(0) = sqrt(2 j + 1) (-1)^(j - r) (j + r)! / ((j - r)! r!).
Vector<Mpfr> derivative(const Problem<Mpfr>& problem, const StepPolynomials& step, int order) {
  const int r = order - 1, s = static_cast<int>(step.gamma.rows());
  Vector<Mpfr> momentum = Vector<Mpfr>::Zero(problem.m()), velocity = momentum;
  for (int j = r; j < s; ++j) {
    Mpfr value = sqrt(Mpfr(2 * j + 1));
    for (int i = j - r + 1; i <= j + r; ++i) value *= i;
    for (int i = 2; i <= r; ++i) value /= i;
    if ((j - r) % 2 != 0) value = -value;
    for (Index c = 0; c < problem.m(); ++c) momentum[c] += value * step.gamma(j, c);
  }
  problem.mass.velocity(lanes(std::as_const(momentum)), lanes(velocity));
  return velocity / pow(step.h, r);
}

/// (nabla^2 g)(v, w) of each constraint at q.
Vector<Mpfr> second_derivative(const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& v,
                               const Vector<Mpfr>& w) {
  Vector<Mpfr> result(problem.nu());
  for (Index a = 0; a < problem.nu(); ++a) {
    const auto of = [&](const Vector<Mpfr>& x) {
      return curvature(problem.constraints[static_cast<std::size_t>(a)], problem.dimension, q, x);
    };
    result[a] = (of(v + w) - of(v - w)) / 4;
  }
  return result;
}

/// grad g^T v of each constraint.
Vector<Mpfr> along(const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& v) {
  ConstraintGradient<Mpfr> gradient(problem, 1);
  gradient.update(lanes(q));
  Vector<Mpfr> result(problem.nu());
  for (Index a = 0; a < problem.nu(); ++a) gradient.transposed_times(a, lanes(v), &result[a]);
  return result;
}

/// psi = grad g^T q^(s+1) and psi' at a state, from a step of many stages.
struct LeadingTerm {
  Vector<Mpfr> psi, derivative;
};
LeadingTerm leading_term(const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& p, int s) {
  const ReferenceMotion motion(problem, q, p, ldexp(Mpfr(1), -10), 1, s + 8);
  const Vector<Mpfr> first = derivative(problem, motion.polynomials(), 1),
                     next = derivative(problem, motion.polynomials(), s + 1),
                     after = derivative(problem, motion.polynomials(), s + 2);
  return {along(problem, q, next), second_derivative(problem, q, first, next) + along(problem, q, after)};
}

/// The hidden constraint at t = 1/4 in steps of 2^-8 over what its leading term says:
///
///     w = -kappa h^s (psi(t) - psi(0)), s even;   w = -kappa/2 h^(s+1) (psi'(t) - psi'(0)), s odd, t/h even;
///     kappa = s! / ((s + 1) (2 s)!)
double hidden_constant(const ClaimGroup& group) {
  const PrecisionScope scope(100);
  const Claim& claim = group.subject();
  const int s = claim.method->stages();
  Laboratory laboratory(group);
  const Laboratory::Start& start = laboratory.starts().front();
  const Mpfr until = Mpfr(1) / 4, h = ldexp(Mpfr(1), -8);
  Trial<Mpfr> trial(claim);
  trial.begin(start, h);
  for (long n = 0; n < 64; ++n) trial.step();
  Vector<Mpfr> q = start.q, p = start.p;
  trial.state(q, p);
  const Vector<Mpfr> hidden = laboratory.point().hidden_constraints(q, p);
  const ReferenceMotion motion(laboratory.problem(), start.q, start.p, until, 16, s + 8);
  const LeadingTerm at_start = leading_term(laboratory.problem(), start.q, start.p, s),
                    at_end = leading_term(laboratory.problem(), motion.q(), motion.p(), s);
  Mpfr kappa = Mpfr(1) / (s + 1);
  for (int i = s + 1; i <= 2 * s; ++i) kappa /= i;
  const bool even = s % 2 == 0;
  const Vector<Mpfr> change = even ? at_end.psi - at_start.psi : at_end.derivative - at_start.derivative;
  const Mpfr factor = even ? Mpfr(-kappa * pow(h, s)) : Mpfr(-kappa / 2 * pow(h, s + 1));
  const Vector<Mpfr> predicted = factor * change;
  Mpfr product = 0, square = 0;
  for (Index a = 0; a < predicted.size(); ++a) {
    product += hidden[a] * predicted[a];
    square += predicted[a] * predicted[a];
  }
  return approximately(Mpfr(product / square));
}

/// The greatest hidden constraint up to t = 1280 over that up to t = 20, in steps of 1/10.
double hidden_drift(const Claim& claim) {
  const Assembled<double> scene = assemble<double>(load_scene(claim.problem));
  const auto stepper = claim.method->make_stepper(scene.problem, SolverKind::automatic);
  State<double> state(scene.q0, scene.p0);
  StateEvaluator<double> point(scene.problem);
  double early = 0, greatest = 0;
  for (long n = 1; n <= 12'800; ++n) {
    stepper->step(state, 1 / double{10});
    raise_to(greatest, max_norm(point.hidden_constraints(state.q, state.p)));
    if (n == 200) early = greatest;
  }
  return greatest / early;
}

/// Mean sweeps of the paper's iteration over 64 steps of 1/16 in double.
double mean_sweeps(const ClaimGroup& group) {
  constexpr long steps = 64;
  const PrecisionScope scope(static_cast<unsigned>(digits10<double>()) + guard_digits);
  Laboratory laboratory(group);
  Trial<double> trial(group.subject(), SolverKind::paper);
  trial.begin(laboratory.starts().front(), Mpfr(1) / 16);
  long sweeps = 0;
  for (long n = 0; n < steps; ++n) sweeps += trial.step();
  return static_cast<double>(sweeps) / steps;
}

}  // namespace

double special_value(const ClaimGroup& group) {
  const Claim& claim = group.subject();
  switch (claim.quantity) {
    case Quantity::hidden_constant:
      return hidden_constant(group);
    case Quantity::hidden_drift:
      return hidden_drift(claim);
    case Quantity::sweeps: {
      ClaimGroup least = group;
      least.claims.front().method = hbvm_of({claim.method->stages(), claim.method->stages()});
      return mean_sweeps(group) - mean_sweeps(least);
    }
    default:
      throw InputError("quantity '" + std::string(name_of(claim.quantity)) + "' is measured by its rate");
  }
}

}  // namespace hbvm::core
