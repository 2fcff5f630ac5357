#include "sensitivity.hpp"

#include <random>

#include "reference/reference_motion.hpp"

namespace hbvm::core {
namespace {

/// The greatest magnitude in each block of coordinates, in all its entries.
Vector<Mpfr> block_sizes(const Problem<Mpfr>& problem, const Vector<Mpfr>& x) {
  Vector<Mpfr> sizes(x.size());
  for (Index at = 0; at < x.size(); at += problem.dimension)
    sizes.segment(at, problem.dimension).setConstant(max_norm(Vector<Mpfr>(x.segment(at, problem.dimension))));
  return sizes;
}

}  // namespace

Kick kick(const Problem<Mpfr>& problem, StateEvaluator<Mpfr>& point, int log2_scale, const Vector<Mpfr>& q,
          const Vector<Mpfr>& p, unsigned pattern) {
  const auto sizes = [&](const Vector<Mpfr>& x) { return block_sizes(problem, x); };
  const Mpfr scale = ldexp(Mpfr(1), log2_scale);
  Vector<Mpfr> v(q.size()), a(q.size());
  problem.mass.velocity(lanes(p), lanes(v));
  const auto& forces = point.forces(q, p);
  const Vector<Mpfr> force = sizes(forces.applied) + sizes(forces.constraint);
  problem.mass.velocity(lanes(force), lanes(a));
  Kick kick{sizes(q) + scale * sizes(v) + scale * scale * sizes(a),
            sizes(p) + scale * force + sizes(problem.mass.momentum(q)) / scale};
  std::mt19937 signs(pattern);
  for (Index j = 0; j < q.size(); ++j) {
    if (signs() % 2 == 0) kick.q[j] = -kick.q[j];
    if (signs() % 2 == 0) kick.p[j] = -kick.p[j];
  }
  return kick;
}

Sensitivity Sensitivity::at(const Problem<Mpfr>& problem, StateEvaluator<Mpfr>& point, int log2_scale,
                            const std::vector<MomentumComponent<Mpfr>>& momenta, const Vector<Mpfr>& q,
                            const Vector<Mpfr>& p) {
  // Small enough for its square not to count, and far above the round-off here.
  constexpr int small = 40;
  // Two terms of opposite signs may hide one another in a pattern, hardly in all.
  constexpr unsigned patterns = 4;
  const bool constrained = problem.nu() > 0;
  const Vector<Mpfr> lambda = point.multiplier(q, p), hidden = point.hidden_constraints(q, p), g = point.constraints(q);
  const Mpfr H = point.energy(q, p), balance = point.balance(q, p);
  Mpfr of_q = 0, of_p = 0, of_lambda = 0, of_hidden = 0, of_H = 0, of_balance = 0, of_g = 0;
  std::vector<Mpfr> of_momenta(momenta.size(), Mpfr(0));
  for (unsigned pattern = 1; pattern <= patterns; ++pattern) {
    const Kick off = kick(problem, point, log2_scale, q, p, pattern);
    raise_to(of_q, max_norm(off.q));
    raise_to(of_p, max_norm(off.p));
    const Vector<Mpfr> q_off = q + ldexp(Mpfr(1), -small) * off.q, p_off = p + ldexp(Mpfr(1), -small) * off.p;
    raise_to(of_H, Mpfr(abs(Mpfr(point.energy(q_off, p_off) - H))));
    raise_to(of_balance, Mpfr(abs(Mpfr(point.balance(q_off, p_off) - balance))));
    for (std::size_t c = 0; c < momenta.size(); ++c)
      raise_to(of_momenta[c], Mpfr(abs(Mpfr(momentum(problem, momenta[c], q_off, p_off).value -
                                            momentum(problem, momenta[c], q, p).value))));
    if (!constrained) continue;
    raise_to(of_lambda, distance(point.multiplier(q_off, p_off), lambda));
    raise_to(of_hidden, distance(point.hidden_constraints(q_off, p_off), hidden));
    raise_to(of_g, distance(point.constraints(q_off), g));
  }
  Sensitivity s{log2_of(of_q),
                log2_of(of_p),
                log2_of(of_lambda) + small,
                log2_of(of_hidden) + small,
                log2_of(of_H) + small,
                log2_of(of_balance) + small,
                log2_of(of_g) + small,
                {}};
  for (const Mpfr& change : of_momenta) s.momenta.push_back(log2_of(change) + small);
  return s;
}

}  // namespace hbvm::core
