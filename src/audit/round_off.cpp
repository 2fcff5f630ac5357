#include <algorithm>
#include <cmath>

#include "measurements.hpp"
#include "sensitivity.hpp"
#include "trial.hpp"

namespace hbvm::core {
namespace {

/// What round-off may do to conserved quantities along a run.
class Allowance {
 public:
  Allowance(const ClaimGroup& group, double log2_epsilon)
      : log2_unit_(log2_epsilon + std::log2(allowed_units(group.subject()))) {}

  /// One more step, with the change that a unit makes there, as log2. \return log2 of all so far
  double step(double sensitivity) {
    steps_ = sum(steps_, sensitivity);
    return log2_unit_ + steps_;
  }

 private:
  /// log2(2^a + 2^b).
  static double sum(double a, double b) {
    const double greater = std::max(a, b);
    return std::isfinite(greater) ? greater + std::log2(std::exp2(a - greater) + std::exp2(b - greater)) : greater;
  }

  double log2_unit_, steps_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

double allowed_units(const Claim& claim) { return 4 * claim.method->terms(); }

template <Scalar S>
std::map<Quantity, RoundOff> round_off(const ClaimGroup& group, const ConservationRun& run) {
  const double last_bit = group.log2_unit<S>();
  Trial<S> trial(group.subject());
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  Laboratory laboratory(group);
  const Problem<Mpfr>& problem = laboratory.problem();
  StateEvaluator<Mpfr>& point = laboratory.point();
  const int log2_h = group.log2_scale + run.log2_step;
  const Mpfr h = ldexp(Mpfr(1), log2_h);
  std::map<Quantity, RoundOff> result;
  const auto add = [&](Quantity quantity, const Mpfr& error, double floor) {
    if (!group.asks_for(quantity)) return;
    const double size = log2_of(error);
    // An error of 0 is none, whatever could have been.
    const double ratio = error == 0 ? 0 : std::exp2(size - floor);
    const RoundOff now{ratio, {static_cast<double>(log2_h), size, floor}};
    const auto [place, is_new] = result.try_emplace(quantity, now);
    if (!is_new && ratio > place->second.ratio) place->second = now;
  };
  std::vector<MomentumComponent<Mpfr>> momenta;
  if (group.asks_for(Quantity::angular_momentum)) momenta = conserved_momenta(problem);
  for (const Laboratory::Start& start : laboratory.starts()) {
    Vector<Mpfr> q = start.q, p = start.p;
    const Mpfr H0 = point.energy(q, p), balance0 = point.balance(q, p);
    std::vector<MomentumValue<Mpfr>> momentum_0;
    for (const auto& component : momenta) momentum_0.push_back(momentum(problem, component, q, p));
    Allowance of_H(group, last_bit), of_balance(group, last_bit), of_g(group, last_bit), of_hidden(group, last_bit),
        of_q(group, last_bit), of_p(group, last_bit);
    std::vector<Allowance> of_momenta(momenta.size(), Allowance(group, last_bit));
    trial.begin(start, h);
    for (long n = 1; n <= run.steps; ++n) {
      const Sensitivity here = Sensitivity::at(problem, point, group.log2_scale, momenta, q, p);
      trial.step();
      group.check_time();
      trial.state(q, p);
      add(Quantity::H, abs(Mpfr(point.energy(q, p) - H0)), of_H.step(here.H));
      add(Quantity::balance, abs(Mpfr(point.balance(q, p) - balance0)), of_balance.step(here.balance));
      if (problem.nu() > 0) add(Quantity::g, max_norm(point.constraints(q)), of_g.step(here.g));
      if (problem.nu() > 0)
        add(Quantity::hidden, max_norm(point.hidden_constraints(q, p)), of_hidden.step(here.hidden));
      for (std::size_t c = 0; c < momenta.size(); ++c)
        add(Quantity::angular_momentum, abs(Mpfr(momentum(problem, momenta[c], q, p).value - momentum_0[c].value)),
            of_momenta[c].step(here.momenta[c]));
      of_q.step(here.q);
      of_p.step(here.p);
    }
    if (!group.asks_for(Quantity::reversal)) continue;
    // What the way back makes of an error at the turn shows what it makes of all that were made before. So the same way
    // is gone once more from a state that is off.
    const int small = static_cast<int>(last_bit / 2);
    const auto go_back = [&](Vector<Mpfr>& to_q, Vector<Mpfr>& to_p) {
      for (long n = 1; n <= run.steps; ++n) {
        trial.step();
        group.check_time();
      }
      trial.reverse();
      trial.state(to_q, to_p);
    };
    const Kick off = kick(problem, point, group.log2_scale, q, p, 1);
    const Mpfr factor = ldexp(Mpfr(1), small);
    Vector<Mpfr> near_q = q, near_p = p, back_q = q, back_p = p;
    trial.reverse();
    go_back(back_q, back_p);
    trial.begin({q + factor * off.q, p + factor * off.p}, h);
    trial.reverse();
    go_back(near_q, near_p);
    const double grown_q = log2_of(laboratory.apart(near_q, back_q)) - small,
                 grown_p = log2_of(laboratory.apart(near_p, back_p)) - small;
    const double steps = std::log2(2 * static_cast<double>(run.steps));
    add(Quantity::reversal, laboratory.apart(back_q, start.q),
        std::max(of_q.step(grown_q + steps), of_q.step(grown_q)));
    add(Quantity::reversal, laboratory.apart(back_p, start.p),
        std::max(of_p.step(grown_p + steps), of_p.step(grown_p)));
  }
  return result;
}

#define HBVM_DEFINE(S) template std::map<Quantity, RoundOff> round_off<S>(const ClaimGroup&, const ConservationRun&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
