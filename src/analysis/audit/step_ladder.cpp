#include <algorithm>

#include "hbvm/reference/closed_form.hpp"
#include "measurements.hpp"

namespace hbvm {
namespace {

/// What a few hundred roundings add up to, at most, in units of the last digit, as log2.
constexpr double step_roundings = 12;

/// One step of the method from one state against the exact motion.
template <Scalar S>
class StepMeasurement {
 public:
  StepMeasurement(Laboratory& laboratory, const Cell& cell, double log2_epsilon)
      : laboratory_(laboratory), subject_(cell.subject()), unit_(log2_epsilon + step_roundings), s_(cell.stages()) {}

  Margins measure(Trial<S>& trial, const Laboratory::Start& start, double log2_h, Sizes& sizes) {
    const Problem<Mpfr>& problem = laboratory_.problem();
    Point<Mpfr>& point = laboratory_.point();
    const Mpfr h = ldexp(Mpfr(1), static_cast<int>(log2_h));
    trial.begin(start, h);
    trial.step();
    Vector<Mpfr> q = start.q, p = start.p;
    trial.state(q, p);
    const ReferenceMotion exact(problem, start.q, start.p, h, 1, s_ + 2);

    const double q_unit = unit_ + log2_of(max_norm(start.q)), p_unit = unit_ + log2_of(max_norm(start.p));
    const Margins margin(exact.errors());
    const auto add = [&](Quantity quantity, const Mpfr& error, double floor) {
      raise(sizes, quantity, log2_of(error), floor);
    };
    Vector<Mpfr> exact_q = exact.q(), exact_p = exact.p(), exact_lambda = exact.lambda();
    if (const auto point_there = closed_form(subject_.problem, h)) {
      exact_q = point_there->q;
      exact_p = point_there->p;
      exact_lambda = point.multiplier(exact_q, exact_p);
    }
    add(Quantity::q, distance(q, exact_q), std::max({q_unit, p_unit + log2_h, margin.q}));
    add(Quantity::p, distance(p, exact_p), std::max(p_unit, margin.p));
    add(Quantity::H, abs(Mpfr(point.energy(q, p) - point.energy(start.q, start.p))),
        unit_ + log2_of(point.energy_size(start.q, start.p)));
    if (trial.has_polynomials())
      add_polynomials(trial, start, h, p, exact, std::max({q_unit, p_unit, margin.q, margin.p}), sizes);
    if (problem.nu() == 0) return margin;

    const Vector<Mpfr> tangential = point.tangential(q, p), output_lambda = point.multiplier(q, tangential);
    Vector<Mpfr> lambda = output_lambda;
    trial.multiplier(lambda);
    const double lambda_unit = std::max({unit_ + log2_of(max_norm(exact_lambda)), p_unit, q_unit});
    const Mpfr hidden = max_norm(point.hidden_constraints(q, p));
    add(Quantity::tangential_p, distance(tangential, exact_p), std::max({p_unit, q_unit, margin.p}));
    add(Quantity::output_lambda, distance(output_lambda, exact_lambda), std::max(lambda_unit, margin.lambda));
    // Multipliers come from momenta divided by h.
    add(Quantity::lagmul, distance(lambda, exact_lambda), std::max(lambda_unit - log2_h, margin.lambda));
    add(Quantity::hidden, hidden, q_unit + p_unit - unit_ + 4);
    add(Quantity::delta_lambda, delta_lambda(laboratory_, trial, start.q, p, h, s_), lambda_unit - log2_h);
    return margin;
  }

 private:
  void add_polynomials(Trial<S>& trial, const Laboratory::Start& start, const Mpfr& h, const Vector<Mpfr>& p1,
                       const ReferenceMotion& exact, double floor, Sizes& sizes) {
    constexpr int points = 8;
    const Problem<Mpfr>& problem = laboratory_.problem();
    const StepPolynomials own = polynomials(trial, start.q, p1, h, s_);
    Vector<Mpfr> u = start.q, v = start.p, exact_u = u, exact_v = v;
    Mpfr error = 0;
    for (int i = 1; i <= points; ++i) {
      const Mpfr tau = Mpfr(i) / points;
      own.at(problem, tau, u, v);
      exact.polynomials().at(problem, tau, exact_u, exact_v);
      raise_to(error, distance(u, exact_u));
      raise_to(error, distance(v, exact_v));
    }
    raise(sizes, Quantity::polynomials, log2_of(error), floor);
  }

  Laboratory& laboratory_;
  const Claim& subject_;
  double unit_;
  int s_;
};

}  // namespace

template <Scalar S>
Ladders step_ladder(const Cell& cell, const Enough& enough) {
  const double log2_epsilon = 1 - significand_bits<S>();
  Trial<S> trial(cell.subject());
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  Laboratory laboratory(cell.subject().problem, cell.first_start, cell.starts);
  StepMeasurement<S> measurement(laboratory, cell, log2_epsilon);
  Ladders ladders;
  for (int exponent = 2; exponent <= 128; exponent += exponent < 12 ? 1 : 4) {
    Sizes sizes;
    Margins margins;
    try {
      for (const Laboratory::Start& start : laboratory.starts())
        margins.raise(measurement.measure(trial, start, -exponent, sizes));
    } catch (const StageFailure&) {
      if (exponent >= 12 && ladders.empty()) break;
      continue;  // the step is too large for the solver, or too small for the digits
    }
    for (const auto& [quantity, size] : sizes)
      ladders[quantity].push_back({static_cast<double>(-exponent), size.error, size.floor, margins.set(size.floor)});
    if (enough(ladders)) break;
  }
  return ladders;
}

#define HBVM_DEFINE(S) template Ladders step_ladder<S>(const Cell&, const Enough&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
