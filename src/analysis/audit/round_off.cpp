#include <algorithm>

#include "hbvm/problem/momenta.hpp"
#include "measurements.hpp"

namespace hbvm {

template <Scalar S>
std::map<Quantity, RoundOff> round_off(const Cell& cell) {
  constexpr long steps = 16;
  const int last_bit = 1 - significand_bits<S>();
  Trial<S> trial(cell.subject());
  const PrecisionScope scope(static_cast<unsigned>(digits10<S>()) + guard_digits);
  const Mpfr epsilon_of_S = ldexp(Mpfr(1), last_bit);
  Laboratory laboratory(cell.subject().problem, cell.first_start, cell.starts);
  const Problem<Mpfr>& problem = laboratory.problem();
  Point<Mpfr>& point = laboratory.point();
  const Mpfr h = Mpfr(1) / steps;
  std::map<Quantity, RoundOff> result;
  const auto add = [&](Quantity quantity, const Mpfr& error, const Mpfr& size) {
    if (!cell.asks_for(quantity)) return;
    const Mpfr unit = size * epsilon_of_S;
    RoundOff& entry =
        result.try_emplace(quantity, RoundOff{0, {log2_of(h), log2_of(error), log2_of(unit)}}).first->second;
    const double units = error == 0 ? 0 : approximately(Mpfr(error / unit));
    if (units <= entry.units) return;
    entry = {units, {log2_of(h), log2_of(error), log2_of(unit)}};
  };
  std::vector<MomentumComponent<Mpfr>> momenta;
  if (cell.asks_for(Quantity::angular_momentum)) momenta = conserved_momenta(problem);
  for (const Laboratory::Start& start : laboratory.starts()) {
    Vector<Mpfr> q = start.q, p = start.p;
    const Mpfr H0 = point.energy(q, p), H_size = point.energy_size(q, p);
    std::vector<MomentumValue<Mpfr>> momentum_0;
    for (const auto& component : momenta) momentum_0.push_back(momentum(problem, component, q, p));
    trial.begin(start, h);
    for (long n = 1; n <= steps; ++n) {
      trial.step();
      trial.state(q, p);
      add(Quantity::H, abs(Mpfr(point.energy(q, p) - H0)), H_size);
      if (problem.nu() > 0) add(Quantity::g, max_norm(point.constraints(q)), point.constraint_size(q));
      for (std::size_t c = 0; c < momenta.size(); ++c)
        add(Quantity::angular_momentum, abs(Mpfr(momentum(problem, momenta[c], q, p).value - momentum_0[c].value)),
            momentum_0[c].size);
    }
    if (!cell.asks_for(Quantity::reversal)) continue;
    trial.reverse();
    for (long n = 1; n <= steps; ++n) trial.step();
    trial.reverse();
    trial.state(q, p);
    add(Quantity::reversal, distance(q, start.q), max_norm(start.q));
    add(Quantity::reversal, distance(p, start.p), std::max(max_norm(start.p), max_norm(start.q)));
  }
  return result;
}

#define HBVM_DEFINE(S) template std::map<Quantity, RoundOff> round_off<S>(const Cell&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
