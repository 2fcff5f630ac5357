#include <algorithm>

#include "error_sizes.hpp"
#include "measurements.hpp"
#include "sensitivity.hpp"
#include "trial.hpp"

namespace hbvm::core {
namespace {

/// What a few hundred roundings add up to, at most, in units of round-off, as log2.
constexpr double step_roundings = 12;

/// One step of the method from one state against the exact motion.
template <Scalar S>
class StepMeasurement {
 public:
  StepMeasurement(Laboratory& laboratory, const ClaimGroup& group, double log2_epsilon)
      : laboratory_(laboratory), group_(group), unit_(log2_epsilon + step_roundings), s_(group.stages()) {
    for (const Laboratory::Start& start : laboratory.starts())
      sensitivities_.push_back(
          Sensitivity::at(laboratory.problem(), laboratory.point(), group.log2_scale, {}, start.q, start.p));
  }

  /// From start number i.
  Margins measure(Trial<S>& trial, std::size_t i, int log2_h, ErrorSizes& sizes) {
    const Problem<Mpfr>& problem = laboratory_.problem();
    StateEvaluator<Mpfr>& point = laboratory_.point();
    const Laboratory::Start& start = laboratory_.starts()[i];
    const Sensitivity& sensitivity = sensitivities_[i];
    const Mpfr h = ldexp(Mpfr(1), log2_h);
    trial.begin(start, h);
    trial.step();
    group_.check_time();
    Vector<Mpfr> q = start.q, p = start.p;
    trial.state(q, p);
    const ReferenceMotion exact(problem, start.q, start.p, h, 1, s_ + 2);
    group_.check_time();

    const double q_unit = unit_ + sensitivity.q, p_unit = unit_ + sensitivity.p;
    const Margins margin(exact.errors());
    const auto add = [&](Quantity quantity, const Mpfr& error, double floor) {
      raise(sizes, quantity, log2_of(error), floor);
    };
    Vector<Mpfr> exact_q = exact.q(), exact_p = exact.p(), exact_lambda = exact.lambda();
    if (const auto known = laboratory_.known(start, h)) {
      exact_q = known->q;
      exact_p = known->p;
      exact_lambda = known->lambda;
    }
    const auto apart = [&](const Vector<Mpfr>& a, const Vector<Mpfr>& b) { return laboratory_.apart(a, b); };
    add(Quantity::q, apart(q, exact_q), std::max(q_unit, margin.q));
    add(Quantity::p, apart(p, exact_p), std::max(p_unit, margin.p));
    add(Quantity::H, abs(Mpfr(point.energy(q, p) - point.energy(start.q, start.p))), unit_ + sensitivity.H);
    add(Quantity::balance, abs(Mpfr(point.balance(q, p) - point.balance(start.q, start.p))),
        unit_ + sensitivity.balance);
    if (trial.has_polynomials())
      add_polynomials(trial, start, h, p, exact, std::max({q_unit, p_unit, margin.q, margin.p}), sizes);
    if (problem.nu() == 0) return margin;

    const Vector<Mpfr> tangential = point.tangential(q, p), output_lambda = point.multiplier(q, tangential);
    Vector<Mpfr> lambda = output_lambda;
    trial.multiplier(lambda);
    // Multipliers come from momenta divided by h.
    const double lambda_unit = unit_ + sensitivity.lambda,
                 divided = lambda_unit + std::max(group_.log2_scale - log2_h, 0);
    const Mpfr hidden = max_norm(point.hidden_constraints(q, p));
    if (group_.asks_for(Quantity::g)) {
      const Vector<Mpfr> g_0 = point.constraints(start.q);
      add(Quantity::g, distance(point.constraints(q), g_0), unit_ + sensitivity.g);
    }
    add(Quantity::tangential_p, apart(tangential, exact_p), std::max(p_unit, margin.p));
    add(Quantity::output_lambda, distance(output_lambda, exact_lambda), std::max(lambda_unit, margin.lambda));
    add(Quantity::lagmul, distance(lambda, exact_lambda), std::max(divided, margin.lambda));
    add(Quantity::hidden, hidden, unit_ + sensitivity.hidden);
    if (trial.has_polynomials())
      add(Quantity::delta_lambda, delta_lambda(laboratory_, trial, start.q, p, h, s_), divided);
    return margin;
  }

 private:
  void add_polynomials(Trial<S>& trial, const Laboratory::Start& start, const Mpfr& h, const Vector<Mpfr>& p1,
                       const ReferenceMotion& exact, double floor, ErrorSizes& sizes) {
    constexpr int points = 8;
    const Problem<Mpfr>& problem = laboratory_.problem();
    const StepPolynomials own = polynomials(trial, start.q, p1, h, s_);
    Vector<Mpfr> u = start.q, v = start.p, exact_u = u, exact_v = v;
    Mpfr error = 0;
    for (int i = 1; i <= points; ++i) {
      const Mpfr tau = Mpfr(i) / points;
      own.at(problem, tau, u, v);
      exact.polynomials().at(problem, tau, exact_u, exact_v);
      raise_to(error, laboratory_.apart(u, exact_u));
      raise_to(error, laboratory_.apart(v, exact_v));
    }
    raise(sizes, Quantity::polynomials, log2_of(error), floor);
  }

  Laboratory& laboratory_;
  const ClaimGroup& group_;
  double unit_;
  int s_;
  std::vector<Sensitivity> sensitivities_;
};

}  // namespace

template <Scalar S>
Ladders step_ladder(const ClaimGroup& group, const Enough& enough) {
  const double log2_epsilon = group.log2_unit<S>();
  Trial<S> trial(group.subject());
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  Laboratory laboratory(group);
  StepMeasurement<S> measurement(laboratory, group, log2_epsilon);
  Ladders ladders;
  for (int exponent = 2; exponent <= 128; exponent += exponent < 12 ? 1 : 4) {
    const int log2_h = group.log2_scale - exponent;
    ErrorSizes sizes;
    Margins margins;
    try {
      for (std::size_t i = 0; i < laboratory.starts().size(); ++i)
        margins.raise(measurement.measure(trial, i, log2_h, sizes));
    } catch (const StageFailure&) {
      if (exponent >= 12 && ladders.empty()) break;
      continue;  // the step is too large for the solver, or too small for the digits
    }
    for (const auto& [quantity, size] : sizes)
      ladders[quantity].push_back({static_cast<double>(log2_h), size.error, size.floor, margins.set(size.floor)});
    if (enough(ladders)) break;
  }
  return ladders;
}

#define HBVM_DEFINE(S) template Ladders step_ladder<S>(const ClaimGroup&, const Enough&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
