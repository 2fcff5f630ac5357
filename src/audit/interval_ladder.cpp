#include <algorithm>
#include <deque>

#include "error_sizes.hpp"
#include "measurements.hpp"
#include "problem/momenta.hpp"
#include "sensitivity.hpp"
#include "trial.hpp"

namespace hbvm::core {
namespace {

/// What some thousand steps' roundings add up to, in units of the last digit, as log2.
constexpr double run_roundings = 14;

/// The exact motion from one start, at the end of the interval.
class Destination {
 public:
  Destination(Laboratory& laboratory, const ClaimGroup& group, const Laboratory::Start& start, const Mpfr& until)
      : laboratory_(laboratory),
        group_(group),
        start_(start),
        until_(until),
        steps_(16 * group.windows),
        most_steps_(8'192 * group.windows),
        known_(laboratory.known(start, until)) {}

  /// At least so exact if that can be had: log2 of the errors wanted. More stages are tried first, then shorter steps.
  /// \throws StageFailure
  void sharpen(double wanted_q, double wanted_p) {
    if (known_) return;
    for (int refinements = 0;; ++refinements) {
      try {
        if (!motion_)
          motion_.emplace(laboratory_.problem(), start_.q, start_.p, until_, steps_, group_.stages() + 2,
                          [this] { group_.check_time(); });
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
  const ClaimGroup& group_;
  const Laboratory::Start& start_;
  Mpfr until_;
  long steps_, most_steps_;
  std::optional<ExactPoint> known_;
  std::optional<ReferenceMotion> motion_;
};

/// Runs from every start through the interval, and what is measured of them.
template <Scalar S>
class IntervalLadder {
 public:
  /// \param unit of round-off in S, as log2, with what the steps of a run add up to
  IntervalLadder(const ClaimGroup& group, double unit)
      : unit_(unit),
        group_(group),
        laboratory_(group),
        problem_(laboratory_.problem()),
        point_(laboratory_.point()),
        log2_window_(group.log2_scale + group.log2_interval),
        end_errors_(group.asks_for(Quantity::q) || group.asks_for(Quantity::p) ||
                    group.asks_for(Quantity::tangential_p) || group.asks_for(Quantity::lagmul) ||
                    group.asks_for(Quantity::output_lambda)),
        between_(group.asks_for(Quantity::q_between) || group.asks_for(Quantity::p_between) ||
                 group.asks_for(Quantity::lambda_between)) {
    if (group.asks_for(Quantity::angular_momentum)) momenta_ = conserved_momenta(problem_);
    const Mpfr until = group.windows * ldexp(Mpfr(1), log2_window_);
    for (const Laboratory::Start& start : laboratory_.starts()) {
      destinations_.emplace_back(laboratory_, group, start, until);
      sensitivities_.push_back(Sensitivity::at(problem_, point_, group.log2_scale, momenta_, start.q, start.p));
    }
  }

  /// The errors with n steps a window are added to `ladders`. \throws StageFailure if the step is too large
  void measure(Trial<S>& trial, long n, Ladders& ladders) {
    sizes_.clear();
    Margins margins;
    const Mpfr h = ldexp(Mpfr(1), log2_window_) / n;
    const double log2_h = log2_of(h);
    for (std::size_t i = 0; i < laboratory_.starts().size(); ++i) {
      const Sensitivity& sensitivity = sensitivities_[i];
      const Floors floors{unit_ + sensitivity.q, unit_ + sensitivity.p, unit_ + sensitivity.lambda,
                          unit_ + sensitivity.lambda + std::max(group_.log2_scale - log2_h, double{0})};
      Vector<Mpfr> q, p;
      run(trial, laboratory_.starts()[i], h, n * group_.windows, sensitivity, floors, q, p);
      if (!end_errors_ && !between_) continue;
      Destination& exact = destinations_[i];
      const Vector<Mpfr> tangential = point_.tangential(q, p);
      sharpen(exact, sensitivity, floors, q, tangential);
      margins.raise(Margins(exact.errors()));
      if (end_errors_) compare(trial, exact, floors, q, p, tangential);
      if (between_) compare_between(trial, exact, floors, h);
    }
    for (const auto& [quantity, size] : sizes_)
      ladders[quantity].push_back({log2_h, size.error, size.floor, margins.set(size.floor)});
  }

 private:
  /// What round-off makes of the errors, as log2; `divided` that of the multiplier by way of h.
  struct Floors {
    double q, p, lambda, divided;
  };

  void add(Quantity quantity, const Mpfr& error, double floor) { raise(sizes_, quantity, log2_of(error), floor); }

  /// All steps, and what is looked at after each. \param q, p the state at the end
  void run(Trial<S>& trial, const Laboratory::Start& start, const Mpfr& h, long steps, const Sensitivity& sensitivity,
           const Floors& floors, Vector<Mpfr>& q, Vector<Mpfr>& p) {
    q = start.q;
    p = start.p;
    const Mpfr H0 = point_.energy(q, p), balance0 = point_.balance(q, p);
    std::vector<MomentumValue<Mpfr>> momentum_0;
    for (const auto& component : momenta_) momentum_0.push_back(momentum(problem_, component, q, p));
    const bool constrained = problem_.nu() > 0, asks_for_g = constrained && group_.asks_for(Quantity::g);
    const Vector<Mpfr> g_0 = asks_for_g ? point_.constraints(q) : Vector<Mpfr>();
    trial.begin(start, h);
    for (long step = 1; step <= steps; ++step) {
      group_.check_time();
      const Vector<Mpfr> before = q;
      trial.step();
      trial.state(q, p);
      if (constrained && trial.has_polynomials() && group_.asks_for(Quantity::delta_lambda))
        add(Quantity::delta_lambda, delta_lambda(laboratory_, trial, before, p, h, group_.subject().method->stages()),
            floors.divided);
      if (group_.asks_for(Quantity::H)) add(Quantity::H, abs(Mpfr(point_.energy(q, p) - H0)), unit_ + sensitivity.H);
      if (group_.asks_for(Quantity::balance))
        add(Quantity::balance, abs(Mpfr(point_.balance(q, p) - balance0)), unit_ + sensitivity.balance);
      if (asks_for_g) add(Quantity::g, distance(point_.constraints(q), g_0), unit_ + sensitivity.g);
      if (constrained && group_.asks_for(Quantity::hidden))
        add(Quantity::hidden, max_norm(point_.hidden_constraints(q, p)), unit_ + sensitivity.hidden);
      for (std::size_t c = 0; c < momenta_.size(); ++c)
        add(Quantity::angular_momentum, abs(Mpfr(momentum(problem_, momenta_[c], q, p).value - momentum_0[c].value)),
            unit_ + sensitivity.momenta[c]);
    }
  }

  /// The reference must be better than what is measured, which it takes a reference to know.
  void sharpen(Destination& exact, const Sensitivity& sensitivity, const Floors& floors, const Vector<Mpfr>& q,
               const Vector<Mpfr>& tangential) {
    exact.sharpen(sensitivity.q, sensitivity.p);
    for (bool improves = true; improves;) {
      const ReferenceMotion::Errors before = exact.errors();
      exact.sharpen(std::max(log2_of(laboratory_.apart(q, exact.q())), floors.q) - 8,
                    std::max(log2_of(laboratory_.apart(tangential, exact.p())), floors.p) - 8);
      improves = exact.errors().q < before.q || exact.errors().p < before.p;
    }
  }

  /// The errors at the end.
  void compare(Trial<S>& trial, const Destination& exact, const Floors& floors, const Vector<Mpfr>& q,
               const Vector<Mpfr>& p, const Vector<Mpfr>& tangential) {
    const Margins margin(exact.errors());
    add(Quantity::q, laboratory_.apart(q, exact.q()), std::max(floors.q, margin.q));
    add(Quantity::p, laboratory_.apart(p, exact.p()), std::max(floors.p, margin.p));
    if (problem_.nu() == 0) return;
    add(Quantity::tangential_p, laboratory_.apart(tangential, exact.p()), std::max(floors.p, margin.p));
    const Vector<Mpfr> exact_lambda = point_.multiplier(exact.q(), exact.p());
    Vector<Mpfr> lambda = exact_lambda;
    trial.multiplier(lambda);
    add(Quantity::output_lambda, distance(point_.multiplier(q, tangential), exact_lambda),
        std::max(floors.lambda, margin.lambda));
    add(Quantity::lagmul, distance(lambda, exact_lambda), std::max(floors.divided, margin.lambda));
  }

  /// The errors at five points within the step that would follow.
  void compare_between(Trial<S>& trial, const Destination& exact, const Floors& floors, const Mpfr& h) {
    constexpr int points = 5;
    Vector<Mpfr> q = exact.q(), p = exact.p(), lambda = point_.multiplier(q, p);
    for (int i = 0; i < points; ++i) {
      const Mpfr after = h * (2 * i + 1) / (2 * points);
      trial.between(after, q, p, lambda);
      const ReferenceMotion there(problem_, exact.q(), exact.p(), after, 1, group_.stages() + 2,
                                  [this] { group_.check_time(); });
      const Margins end(exact.errors()), own(there.errors());
      add(Quantity::q_between, laboratory_.apart(q, there.q()), std::max({floors.q, end.q, own.q}));
      add(Quantity::p_between, laboratory_.apart(p, there.p()), std::max({floors.p, end.p, own.p}));
      add(Quantity::lambda_between, distance(lambda, there.lambda()),
          std::max({floors.lambda, end.lambda, own.lambda}));
    }
  }

  double unit_;
  const ClaimGroup& group_;
  Laboratory laboratory_;
  const Problem<Mpfr>& problem_;
  StateEvaluator<Mpfr>& point_;
  int log2_window_;
  bool end_errors_, between_;
  std::vector<MomentumComponent<Mpfr>> momenta_;
  std::deque<Destination> destinations_;
  std::vector<Sensitivity> sensitivities_;
  ErrorSizes sizes_;
};

}  // namespace

template <Scalar S>
Ladders interval_ladder(const ClaimGroup& group, long most, const Enough& enough) {
  const double unit = group.log2_unit<S>() + run_roundings;  // in the scope of S
  Trial<S> trial(group.subject());
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  IntervalLadder<S> ladder(group, unit);
  Ladders ladders;
  for (long n = 4; n <= most; n *= 2) {
    try {
      ladder.measure(trial, n, ladders);
    } catch (const StageFailure&) {
      continue;  // the step is too large for the solver
    }
    if (enough(ladders)) break;
  }
  return ladders;
}

#define HBVM_DEFINE(S) template Ladders interval_ladder<S>(const ClaimGroup&, long, const Enough&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
