#pragma once

#include <vector>

#include "problem/momenta.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// What one unit of round-off in a state does to all that is measured there: log2 of the change for an epsilon of 1.
/// Each block of coordinates is off by a unit of the sum of three sizes. These are its own size, its change within the
/// time scale, and what the other half of the state makes of that. In any units, and whatever else is in the scene.
struct Sensitivity {
  double q, p, lambda, hidden, H, balance, g;
  std::vector<double> momenta;

  /// \param point of the problem \throws IntegrationError if gradients are dependent, against (3), at q
  static Sensitivity at(const Problem<Mpfr>& problem, StateEvaluator<Mpfr>& point, int log2_scale,
                        const std::vector<MomentumComponent<Mpfr>>& momenta, const Vector<Mpfr>& q,
                        const Vector<Mpfr>& p);
};

/// ErrorSizes of such errors, entry by entry, with signs that follow a pattern.
struct Kick {
  Vector<Mpfr> q, p;
};
Kick kick(const Problem<Mpfr>& problem, StateEvaluator<Mpfr>& point, int log2_scale, const Vector<Mpfr>& q,
          const Vector<Mpfr>& p, unsigned pattern);

}  // namespace hbvm::core
