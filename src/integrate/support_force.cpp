#include "integrate/support_force.hpp"

#include "problem/redundant_constraints.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// The scene with the body free. Its mass matrix plays no part. As a fixed body may have a second moment that a free
/// one has not, the diagonal of it is doubled.
Scene with_free_body(Scene scene, const std::string& name) {
  for (SceneRigidBody& body : scene.rigid_bodies) {
    if (body.name != name) continue;
    body.fixed = false;
    body.velocity = SceneVector(body.position.size(), Expression::parse("0"));
    for (std::size_t i = 0; i < body.second_moment.size(); ++i)
      body.second_moment[i][i] = Expression::parse("2*(" + body.second_moment[i][i].text() + ")");
  }
  return scene;
}

template <Scalar S>
Vector<S> exact_numbers(const SceneVector& v, const Constants& constants) {
  Vector<S> result(static_cast<Index>(v.size()));
  for (Index i = 0; i < result.size(); ++i) result[i] = evaluate<S>(v[static_cast<std::size_t>(i)], constants);
  return result;
}

}  // namespace

template <Scalar S>
SupportForce<S>::SupportForce(const Scene& scene, const Problem<S>& problem, const SceneRigidBody& body)
    : problem_(problem),
      free_(assemble<S>(with_free_body(scene, body.name), Consistency::unchecked).problem),
      reference_(exact_numbers<S>(body.position, scene.constants)),
      center_(exact_numbers<S>(body.center, scene.constants) * evaluate<S>(body.mass, scene.constants)) {
  origin_ = scene.dimension * static_cast<Index>(scene.bodies.size());
  for (const SceneRigidBody& other : scene.rigid_bodies) {
    if (other.name == body.name) break;
    origin_ += scene.dimension * (scene.dimension + (other.fixed ? 0 : 1));
  }
  // In the same order. The free body has more of them: common points that are left out where both are fixed.
  const std::vector<std::string> names = names_of_constraints(problem);
  Index next = 0;
  for (const Constraint<S>& constraint : free_.constraints) {
    const bool known =
        next < static_cast<Index>(names.size()) && names[static_cast<std::size_t>(next)] == constraint.name;
    multipliers_.push_back(known ? next++ : -1);
  }
  potential_ = std::make_unique<PotentialEvaluator<S>>(free_.potential, 1);
  gradient_ = std::make_unique<ConstraintGradient<S>>(free_, 1);
}

template <Scalar S>
Vector<S> SupportForce<S>::operator()(const SeenState<S>& state) {
  const Index d = problem_.dimension, before = origin_, after = state.q.size() - origin_;
  Vector<S> q(state.q.size() + d);
  q << state.q.head(before), reference_, state.q.tail(after);
  Matrix<S> force, lambda(1, free_.nu());
  potential_->force(lanes(q), force);
  gradient_->update(lanes(q));
  for (Index a = 0; a < free_.nu(); ++a) {
    const Index at = multipliers_[static_cast<std::size_t>(a)];
    lambda(0, a) = at < 0 ? S(0) : S(-state.lambda[at]);
  }
  Vector<S> rate = force.transpose();
  gradient_->add_times(lambda, lanes(rate));
  // The forces on all other coordinates are those of the scene itself.
  Vector<S> own(state.q.size()), acceleration(state.q.size());
  own << rate.head(before), rate.tail(after);
  problem_.mass.velocity(lanes(std::as_const(own)), lanes(acceleration));
  Vector<S> result = -rate.segment(origin_, d);
  for (Index i = 0; i < d; ++i) result += center_[i] * acceleration.segment(origin_ + d * i, d);
  return result;
}

#define HBVM_DEFINE(S) template class SupportForce<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
