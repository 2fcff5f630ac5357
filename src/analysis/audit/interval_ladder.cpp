#include <algorithm>
#include <deque>

#include "hbvm/problem/momenta.hpp"
#include "hbvm/reference/closed_form.hpp"
#include "measurements.hpp"
#include "sensitivity.hpp"

namespace hbvm {
namespace {

/// What some thousand steps' roundings add up to, in units of the last digit, as log2.
constexpr double run_roundings = 14;

/// The exact motion from one start, at the end of the interval.
class Destination {
 public:
  Destination(Laboratory& laboratory, const Cell& cell, const Laboratory::Start& start, const Mpfr& until)
      : laboratory_(laboratory),
        cell_(cell),
        start_(start),
        until_(until),
        steps_(16 * cell.windows),
        most_steps_(8'192 * cell.windows),
        known_(closed_form(cell.subject().problem, until)) {}

  /// At least so exact if that can be had: log2 of the errors wanted. More stages are tried first, then shorter steps.
  /// \throws StageFailure
  void sharpen(double wanted_q, double wanted_p) {
    if (known_) return;
    for (int refinements = 0;; ++refinements) {
      try {
        if (!motion_)
          motion_.emplace(laboratory_.problem(), start_.q, start_.p, until_, steps_, cell_.stages() + 2,
                          [this] { cell_.check_time(); });
        if (motion_->errors().q <= wanted_q && motion_->errors().p <= wanted_p) return;
        if (refinements < most_refinements && motion_->refine()) continue;
        if (motion_->is_exact() || steps_ >= most_steps_) return;
      } catch (const StageFailure&) {
        if (steps_ >= most_steps_) throw;
      }
      motion_.reset();
      steps_ *= 8;
      refinements = 0;
    }
  }
  const Vector<Mpfr>& q() const { return known_ ? known_->q : motion_->q(); }
  const Vector<Mpfr>& p() const { return known_ ? known_->p : motion_->p(); }
  ReferenceMotion::Errors errors() const {
    const auto round_off = static_cast<double>(-mpfr_working_bits());
    return known_ ? ReferenceMotion::Errors{round_off, round_off, round_off} : motion_->errors();
  }

 private:
  static constexpr int most_refinements = 8;

  Laboratory& laboratory_;
  const Cell& cell_;
  const Laboratory::Start& start_;
  Mpfr until_;
  long steps_, most_steps_;
  std::optional<ExactPoint> known_;
  std::optional<ReferenceMotion> motion_;
};

}  // namespace

template <Scalar S>
Ladders interval_ladder(const Cell& cell, long most, const Enough& enough) {
  const double unit = 1 - significand_bits<S>() + run_roundings;
  const Claim& subject = cell.subject();
  Trial<S> trial(subject);
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  Laboratory laboratory(cell);
  const Problem<Mpfr>& problem = laboratory.problem();
  Point<Mpfr>& point = laboratory.point();
  const int log2_window = cell.log2_scale + cell.log2_interval;
  const Mpfr until = cell.windows * ldexp(Mpfr(1), log2_window);
  const bool constrained = problem.nu() > 0;
  const bool end_errors = cell.asks_for(Quantity::q) || cell.asks_for(Quantity::p) ||
                          cell.asks_for(Quantity::tangential_p) || cell.asks_for(Quantity::lagmul) ||
                          cell.asks_for(Quantity::output_lambda);
  std::deque<Destination> destinations;
  for (const Laboratory::Start& start : laboratory.starts()) destinations.emplace_back(laboratory, cell, start, until);
  std::vector<MomentumComponent<Mpfr>> momenta;
  if (cell.asks_for(Quantity::angular_momentum)) momenta = conserved_momenta(problem);

  std::vector<Sensitivity> sensitivities;
  for (const Laboratory::Start& start : laboratory.starts())
    sensitivities.push_back(Sensitivity::at(problem, point, cell.log2_scale, momenta, start.q, start.p));

  Ladders ladders;
  for (long n = 4; n <= most; n *= 2) {
    Sizes sizes;
    Margins margins;
    const Mpfr h = ldexp(Mpfr(1), log2_window) / n;
    const double log2_h = log2_of(h);
    try {
      for (std::size_t i = 0; i < laboratory.starts().size(); ++i) {
        const Laboratory::Start& start = laboratory.starts()[i];
        Destination& exact = destinations[i];
        const Sensitivity& sensitivity = sensitivities[i];
        const double q_unit = unit + sensitivity.q, p_unit = unit + sensitivity.p,
                     lambda_unit = unit + sensitivity.lambda,
                     divided = lambda_unit + std::max(cell.log2_scale - log2_h, double{0});
        const auto add = [&](Quantity quantity, const Mpfr& error, double floor) {
          raise(sizes, quantity, log2_of(error), floor);
        };
        Vector<Mpfr> q = start.q, p = start.p;
        const Mpfr H0 = point.energy(q, p);
        std::vector<MomentumValue<Mpfr>> momentum_0;
        for (const auto& component : momenta) momentum_0.push_back(momentum(problem, component, q, p));
        trial.begin(start, h);
        for (long step = 1; step <= n * cell.windows; ++step) {
          cell.check_time();
          const Vector<Mpfr> before = q;
          trial.step();
          trial.state(q, p);
          if (constrained && trial.has_polynomials() && cell.asks_for(Quantity::delta_lambda))
            add(Quantity::delta_lambda, delta_lambda(laboratory, trial, before, p, h, subject.method->stages()),
                divided);
          if (cell.asks_for(Quantity::H)) add(Quantity::H, abs(Mpfr(point.energy(q, p) - H0)), unit + sensitivity.H);
          if (constrained && cell.asks_for(Quantity::hidden))
            add(Quantity::hidden, max_norm(point.hidden_constraints(q, p)), unit + sensitivity.hidden);
          for (std::size_t c = 0; c < momenta.size(); ++c)
            add(Quantity::angular_momentum, abs(Mpfr(momentum(problem, momenta[c], q, p).value - momentum_0[c].value)),
                unit + sensitivity.momenta[c]);
        }
        if (!end_errors) continue;
        const Vector<Mpfr> tangential = point.tangential(q, p);
        // The reference must be better than what is measured, which it takes a reference to know.
        exact.sharpen(sensitivity.q, sensitivity.p);
        for (bool improves = true; improves;) {
          const ReferenceMotion::Errors before = exact.errors();
          exact.sharpen(std::max(log2_of(distance(q, exact.q())), q_unit) - 8,
                        std::max(log2_of(distance(tangential, exact.p())), p_unit) - 8);
          improves = exact.errors().q < before.q || exact.errors().p < before.p;
        }
        const Margins margin(exact.errors());
        margins.raise(margin);
        add(Quantity::q, distance(q, exact.q()), std::max(q_unit, margin.q));
        add(Quantity::p, distance(p, exact.p()), std::max(p_unit, margin.p));
        if (!constrained) continue;
        add(Quantity::tangential_p, distance(tangential, exact.p()), std::max(p_unit, margin.p));
        const Vector<Mpfr> exact_lambda = point.multiplier(exact.q(), exact.p());
        Vector<Mpfr> lambda = exact_lambda;
        trial.multiplier(lambda);
        add(Quantity::output_lambda, distance(point.multiplier(q, tangential), exact_lambda),
            std::max(lambda_unit, margin.lambda));
        add(Quantity::lagmul, distance(lambda, exact_lambda), std::max(divided, margin.lambda));
      }
    } catch (const StageFailure&) {
      continue;  // the step is too large for the solver
    }
    for (const auto& [quantity, size] : sizes)
      ladders[quantity].push_back({log2_h, size.error, size.floor, margins.set(size.floor)});
    if (enough(ladders)) break;
  }
  return ladders;
}

#define HBVM_DEFINE(S) template Ladders interval_ladder<S>(const Cell&, long, const Enough&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
