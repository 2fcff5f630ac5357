#include "problem/state_evaluator.hpp"

#include "hbvm/error.hpp"
#include "linear/product.hpp"
#include "problem/gram_factor.hpp"

namespace hbvm::core {

template <Scalar S>
StateEvaluator<S>::StateEvaluator(const Problem<S>& problem)
    : problem_(problem),
      potential_(problem.potential, 1),
      without_potential_(problem, 1),
      course_(problem, 1),
      gradient_(problem, 1),
      U_(1),
      v_(problem.m()),
      acceleration_(problem.m()),
      g_(problem.nu()),
      hidden_(problem.nu()),
      tangential_(problem.m()),
      multiplier_(problem.nu()),
      force_(1, problem.m()),
      row_(1, problem.nu()) {}

template <Scalar S>
S StateEvaluator<S>::energy(const Vector<S>& q, const Vector<S>& p) {
  problem_.mass.velocity(lanes(p), lanes(v_));
  potential_.values(lanes(q), U_);
  return dot(p, v_) / 2 - U_[0];
}

template <Scalar S>
S StateEvaluator<S>::account(const Vector<S>& p) const {
  S sum = 0;
  for (Index j = problem_.mass.of_bodies(); j < p.size(); ++j) sum += p[j];
  return sum;
}

template <Scalar S>
void StateEvaluator<S>::set_velocity(const Vector<S>& q, const Vector<S>& p, Vector<S>& v) {
  problem_.mass.velocity(lanes(p), lanes(v));
  if (course_.empty()) return;
  place(course_, problem_, q);
  course_.set_velocities(lanes(v));
}

template <Scalar S>
void StateEvaluator<S>::set_applied(const Vector<S>& q, const Vector<S>& p, Matrix<S>& force) {
  potential_.force(lanes(q), force);
  if (problem_.is_conservative()) return;
  set_velocity(q, p, v_);
  without_potential_.add(lanes(q), lanes(std::as_const(v_)), course_, force);
}

template <Scalar S>
S StateEvaluator<S>::energy_size(const Vector<S>& q, const Vector<S>& p) {
  const S at_rest = energy(q, Vector<S>::Zero(problem_.m()));
  return magnitude(S(energy(q, p) - at_rest)) + magnitude(at_rest);
}

template <Scalar S>
S StateEvaluator<S>::constraint_size(const Vector<S>& q) const {
  S size = 0;
  for (const Constraint<S>& constraint : problem_.constraints)
    raise_to(size, value(constraint, problem_.dimension, q).size);
  return size;
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::constraints(const Vector<S>& q) {
  for (Index a = 0; a < problem_.nu(); ++a)
    g_[a] = value(problem_.constraints[static_cast<std::size_t>(a)], problem_.dimension, q).g;
  return g_;
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::hidden_constraints(const Vector<S>& q, const Vector<S>& p) {
  if (problem_.nu() == 0) return hidden_;
  gradient_.update(lanes(q));
  set_velocity(q, p, v_);
  for (Index a = 0; a < problem_.nu(); ++a) gradient_.transposed_times(a, lanes(std::as_const(v_)), &hidden_[a]);
  return hidden_;
}

template <Scalar S>
void StateEvaluator<S>::solve_gram(Vector<S>& x) {
  const auto refuse_unless = [](bool regular) {
    if (!regular) throw IntegrationError("the constraints' gradients are linearly dependent: (3) does not hold here");
  };
  if (problem_.nu() >= many_constraints) {
    GramFactor<S> gram;
    refuse_unless(gram.factor(gradient_, problem_.nu()));
    return gram.solve(x);
  }
  gradient_.gram(gram_matrix_);
  gram_.set(gram_matrix_);
  refuse_unless(gram_.factor());
  gram_.solve(x);
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::tangential(const Vector<S>& q, const Vector<S>& p) {
  return with_rates(q, p, Vector<S>::Zero(problem_.nu()));
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::with_rates(const Vector<S>& q, const Vector<S>& p, const Vector<S>& rates) {
  tangential_ = p;
  if (problem_.nu() == 0) return tangential_;
  hidden_constraints(q, p);
  hidden_ -= rates;
  solve_gram(hidden_);
  for (Index a = 0; a < problem_.nu(); ++a) row_(0, a) = -hidden_[a];
  // What moves the momentum is an impulse, which does work on driven points.
  for (Index j = problem_.mass.of_bodies(); j < p.size(); ++j) set_zero(tangential_[j]);
  gradient_.add_times(row_, lanes(tangential_));
  course_.make_powers(lanes(tangential_));
  for (Index j = problem_.mass.of_bodies(); j < p.size(); ++j) tangential_[j] += p[j];
  return tangential_;
}

template <Scalar S>
void StateEvaluator<S>::find_multiplier(const Vector<S>& q, const Vector<S>& p, const Matrix<S>& force) {
  // (17), where the curvature of g_a along v is v^T nabla^2 g_a v
  gradient_.update(lanes(q));
  problem_.mass.velocity(lanes(force), lanes(acceleration_));
  set_velocity(q, p, v_);
  course_.set_accelerations(lanes(acceleration_));
  for (Index a = 0; a < problem_.nu(); ++a) {
    gradient_.transposed_times(a, lanes(std::as_const(acceleration_)), &multiplier_[a]);
    multiplier_[a] += curvature(problem_.constraints[static_cast<std::size_t>(a)], problem_.dimension, q, v_);
  }
  if (stabilised_) {
    constraints(q);
    for (Index a = 0; a < problem_.nu(); ++a) {
      gradient_.transposed_times(a, lanes(std::as_const(v_)), &hidden_[a]);
      multiplier_[a] += of_rates_ * hidden_[a] + of_values_ * g_[a];
    }
  }
  solve_gram(multiplier_);
}

template <Scalar S>
void StateEvaluator<S>::stabilise(const S& alpha, const S& beta) {
  of_rates_ = 2 * alpha;
  of_values_ = beta * beta;
  stabilised_ = true;
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::multiplier(const Vector<S>& q, const Vector<S>& p) {
  if (problem_.nu() == 0) return multiplier_;
  set_applied(q, p, force_);
  find_multiplier(q, p, force_);
  return multiplier_;
}

template <Scalar S>
const Vector<S>& StateEvaluator<S>::constraint_force(const Vector<S>& q, const Vector<S>& p, const Matrix<S>& force) {
  forces_.constraint = Vector<S>::Zero(problem_.m());
  if (problem_.nu() == 0) return forces_.constraint;
  find_multiplier(q, p, force);
  for (Index a = 0; a < problem_.nu(); ++a) row_(0, a) = -multiplier_[a];
  gradient_.add_times(row_, lanes(forces_.constraint));
  course_.make_powers(lanes(forces_.constraint));
  return forces_.constraint;
}

template <Scalar S>
const typename StateEvaluator<S>::Forces& StateEvaluator<S>::forces(const Vector<S>& q, const Vector<S>& p) {
  set_applied(q, p, force_);
  forces_.applied = force_.transpose();
  constraint_force(q, p, force_);
  return forces_;
}

#define HBVM_DEFINE(S) template class StateEvaluator<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
