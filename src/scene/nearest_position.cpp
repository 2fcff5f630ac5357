#include "scene/nearest_position.hpp"

#include "hbvm/error.hpp"
#include "linear/lu.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/gram_factor.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// Each sweep minimises the distance under the constraints linearised at the last q. So q = target - M^-1 grad g mu
/// with grad g^T M^-1 grad g mu = g(q) + grad g^T (target - q).
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target) {
  const Index nu = problem.nu();
  StateEvaluator<S> point(problem);
  ConstraintGradient<S> gradient(problem, 1);
  Lu<S> gram;
  GramFactor<S> band;
  Matrix<S> gram_matrix;
  Vector<S> q = target, next(problem.m()), mu(nu);
  Matrix<S> row(1, nu);
  S least = -1;
  // The convergence is linear, the faster the nearer the target is to the constraints.
  const int sweeps = 50 + 10 * digits10<S>();
  for (int sweep = 0, waiting = 0; sweep < sweeps; ++sweep) {
    gradient.update(lanes(q));
    const Vector<S> away = target - q;
    const Vector<S>& g = point.constraints(q);
    for (Index a = 0; a < nu; ++a) {
      gradient.transposed_times(a, lanes(away), &mu[a]);
      mu[a] += g[a];
    }
    if (nu >= many_constraints) {
      if (!band.factor(gradient, nu)) break;
      band.solve(mu);
    } else {
      gradient.gram(gram_matrix);
      gram.set(gram_matrix);
      if (!gram.factor()) break;
      gram.solve(mu);
    }
    for (Index a = 0; a < nu; ++a) row(0, a) = -mu[a];
    next = target;
    gradient.add_weighted_times(row, lanes(next));
    const S increment = distance(next, q);
    q = next;
    if (!is_finite(increment)) break;
    waiting = least < 0 || increment < least ? 0 : waiting + 1;
    if (waiting == 0) least = increment;
    const S tolerance = S(static_cast<long>(16 * (problem.m() + nu))) * epsilon<S>() * max_norm(q);
    if (increment == 0 || (increment <= tolerance && waiting >= 2)) return q;
  }
  throw InputError("no consistent position was found near the given one; the constraints may contradict one another");
}

#define HBVM_DEFINE(S) template Vector<S> nearest_position<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
