#pragma once

#include <algorithm>

#include "linear/constant_count.hpp"
#include "problem/effect/kernel.hpp"

namespace hbvm::core {

/// f(i) for every lane. The forces are another array than q, so that several lanes may be done at a time.
template <class Count, class F>
[[gnu::always_inline]] inline void for_each_lane(Count lanes, F f) {
  if constexpr (is_constant_count<Count>) {
    for (Index i = 0; i < lanes; ++i) f(i);
  } else {
#pragma GCC ivdep
    for (Index i = 0; i < lanes; ++i) f(i);
  }
}

/// For a formula with its dimension d, a number of effects, and a static gradient(x, c, g) that writes d numbers for
/// each. It calls add(i, g) in every lane, where x_of(i, x) gives x. If it can be done in steps, several lanes are done
/// at a time between what is called for each.
template <class Formula, class Count, class XOf, class Add>
[[gnu::always_inline]] inline void for_each_gradient(Count lanes, const double* c, XOf x_of, Add add) {
  if constexpr (requires { Formula::temporaries; } && !is_constant_count<Count>) {
    constexpr Index block = 16;
    double t[Formula::temporaries][block];
    for (Index first = 0; first < lanes; first += block)
      Formula::gradients(
          std::min(block, lanes - first), [&](Index i, double* x) { x_of(first + i, x); }, c, t,
          [&](Index i, const double* g) { add(first + i, g); });
  } else {
    for_each_lane(lanes, [&](Index i) {
      double x[Formula::dimension], g[Formula::dimension * Formula::effects];
      x_of(i, x);
      Formula::gradient(x, c, g);
      add(i, g);
    });
  }
}

/// Kernel::add_force for a formula, where the number of lanes may be a constant.
template <class Formula, class Count>
[[gnu::always_inline]] inline void add_force_in(const KernelSite* sites, std::size_t count,
                                                Lanes<const double, Count> q, double* force) {
  constexpr Index d = Formula::dimension, size = d * Formula::effects;
  const Count lanes = q.count;
  for (const KernelSite* site = sites; site != sites + count; ++site) {
    const double* const a = q[site->a];
    double* const f = force + site->a * lanes;
    if (site->b >= 0) {
      const double* const b = q[site->b];
      double* const opposite = force + site->b * lanes;
      for_each_gradient<Formula>(
          lanes, site->coefficients,
          [&](Index i, double* x) {
            for (Index j = 0; j < d; ++j) x[j] = a[j * lanes + i] - b[j * lanes + i];
          },
          [&](Index i, const double* g) {
            for (Index j = 0; j < size; ++j) f[j % d * lanes + i] += g[j];
            for (Index j = 0; j < size; ++j) opposite[j % d * lanes + i] -= g[j];
          });
    } else {
      for_each_gradient<Formula>(
          lanes, site->coefficients,
          [&](Index i, double* x) {
            for (Index j = 0; j < d; ++j) x[j] = a[j * lanes + i] + site->shift[j];
          },
          [&](Index i, const double* g) {
            for (Index j = 0; j < size; ++j) f[j % d * lanes + i] += g[j];
          });
    }
  }
}

/// The same; of a single lane, of which a loop would be mostly what surrounds it, as a formula.
template <class Formula>
void add_force(const KernelSite* sites, std::size_t count, Lanes<const double> q, double* force) {
  using One = std::integral_constant<Index, 1>;
  if (q.count == 1)
    add_force_in<Formula>(sites, count, Lanes<const double, One>{q.data, One()}, force);
  else
    add_force_in<Formula>(sites, count, q, force);
}

}  // namespace hbvm::core
