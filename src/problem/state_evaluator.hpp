#pragma once

#include "linear/lu.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/force_evaluator.hpp"

namespace hbvm::core {

/// What a problem says at one state (q, p). Owns its storage; one a thread. The problem must outlive it.
template <Scalar S>
class StateEvaluator {
 public:
  explicit StateEvaluator(const Problem<S>& problem);

  /// H = 1/2 p^T M^-1 p - U(q), (1).
  S energy(const Vector<S>& q, const Vector<S>& p);
  /// H - W, which the motion keeps: H + sum p_j over the driven coordinates. W is the work of forces without a
  /// potential and of driven points.
  S balance(const Vector<S>& q, const Vector<S>& p) { return energy(q, p) + account(p); }
  /// -W: the sum of p over the driven coordinates.
  S account(const Vector<S>& p) const;
  /// |T| + |U|, which the round-off of the energy is proportional to.
  S energy_size(const Vector<S>& q, const Vector<S>& p);
  /// g(q), (2).
  const Vector<S>& constraints(const Vector<S>& q);
  /// The greatest sum of the magnitudes of a constraint's terms.
  S constraint_size(const Vector<S>& q) const;
  /// grad g^T M^-1 p, (9), with their own velocities for driven points.
  const Vector<S>& hidden_constraints(const Vector<S>& q, const Vector<S>& p);

  /// p - grad g (grad g^T M^-1 grad g)^-1 grad g^T M^-1 p: the nearest momentum, in the metric M^-1, that fulfils the
  /// hidden constraints. Momenta of driven coordinates change by the work of that impulse.
  /// \throws IntegrationError if the Gram matrix grad g^T M^-1 grad g is singular at q
  const Vector<S>& tangential(const Vector<S>& q, const Vector<S>& p);
  /// The nearest momentum with grad g^T M^-1 p = rates instead of 0. \throws IntegrationError likewise
  const Vector<S>& with_rates(const Vector<S>& q, const Vector<S>& p, const Vector<S>& rates);

  /// The multiplier of Theorem 1 for an exact state,
  /// (grad g^T M^-1 grad g)^-1 (nabla^2 g (M^-1 p, M^-1 p) + grad g^T M^-1 grad U).
  /// \throws IntegrationError as tangential does
  const Vector<S>& multiplier(const Vector<S>& q, const Vector<S>& p);
  /// From now on multipliers hold g'' + 2 alpha g' + beta^2 g = 0, as those of Baumgarte, instead of g'' = 0.
  void stabilise(const S& alpha, const S& beta);
  /// -grad g(q) lambda with that multiplier, where `force` is grad U(q) + F, 1 x m. Of driven coordinates it has the
  /// powers.
  const Vector<S>& constraint_force(const Vector<S>& q, const Vector<S>& p, const Matrix<S>& force);
  /// The one that was computed last.
  const Vector<S>& last_multiplier() const { return multiplier_; }

  /// The two parts of p' = grad U(q) + F - grad g(q) lambda with that multiplier.
  struct Forces {
    Vector<S> applied;     ///< grad U + F
    Vector<S> constraint;  ///< -grad g lambda
  };
  /// \throws IntegrationError as tangential does
  const Forces& forces(const Vector<S>& q, const Vector<S>& p);
  /// p', their sum. \throws IntegrationError likewise
  Vector<S> force(const Vector<S>& q, const Vector<S>& p) {
    const Forces& both = forces(q, p);
    return both.applied + both.constraint;
  }

  /// q' at the state: M^-1 p, and the velocities of driven points.
  void set_velocity(const Vector<S>& q, const Vector<S>& p, Vector<S>& v);
  /// grad U + F, with powers for what acts on driven coordinates: 1 x m.
  void set_applied(const Vector<S>& q, const Vector<S>& p, Matrix<S>& force);

 private:
  /// multiplier_, where `force` is grad U(q).
  void find_multiplier(const Vector<S>& q, const Vector<S>& p, const Matrix<S>& force);
  /// x = (grad g^T M^-1 grad g)^-1 x at the q of the last gradient.
  void solve_gram(Vector<S>& x);

  const Problem<S>& problem_;
  PotentialEvaluator<S> potential_;
  ForceEvaluator<S> without_potential_;
  DrivenCourse<S> course_;
  ConstraintGradient<S> gradient_;
  Lu<S> gram_;
  Vector<S> U_, v_, acceleration_, g_, hidden_, tangential_, multiplier_;
  Matrix<S> force_, row_, gram_matrix_;
  Forces forces_;
  S of_rates_ = 0, of_values_ = 0;  ///< 2 alpha and beta^2
  bool stabilised_ = false;
};

}  // namespace hbvm::core
