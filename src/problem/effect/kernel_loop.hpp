#pragma once

#include "hbvm/problem/effect/kernel.hpp"

namespace hbvm {

/// Kernel::add_force for a formula with a static gradient(x, c, g) and its dimension d. The forces are another array
/// than q, so that lanes may be done several at a time.
template <class Formula>
void add_force(const KernelSite* sites, std::size_t count, Lanes<const double> q, double* force) {
  constexpr Index d = Formula::dimension;
  const Index lanes = q.count;
  for (const KernelSite* site = sites; site != sites + count; ++site) {
    const double* const c = site->coefficients;
    const double* const a = q.data + site->a * lanes;
    double* const f = force + site->a * lanes;
    double x[d], g[d];
    if (site->b >= 0) {
      const double* const b = q.data + site->b * lanes;
      double* const opposite = force + site->b * lanes;
#pragma GCC ivdep
      for (Index i = 0; i < lanes; ++i) {
        for (Index j = 0; j < d; ++j) x[j] = a[j * lanes + i] - b[j * lanes + i];
        Formula::gradient(x, c, g);
        for (Index j = 0; j < d; ++j) f[j * lanes + i] += g[j];
        for (Index j = 0; j < d; ++j) opposite[j * lanes + i] -= g[j];
      }
    } else {
#pragma GCC ivdep
      for (Index i = 0; i < lanes; ++i) {
        for (Index j = 0; j < d; ++j) x[j] = a[j * lanes + i] + site->shift[j];
        Formula::gradient(x, c, g);
        for (Index j = 0; j < d; ++j) f[j * lanes + i] += g[j];
      }
    }
  }
}

}  // namespace hbvm
