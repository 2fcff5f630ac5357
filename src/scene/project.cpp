#include "scene/project.hpp"

#include <Eigen/Geometry>

#include "problem/regularity.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/nearest_position.hpp"
#include "scene/own_precision.hpp"

namespace hbvm::core {
namespace {

/// nearest_position, which says of which scene it is.
template <Scalar S>
Vector<S> nearest_of(const Scene& scene, const Problem<S>& problem, const Vector<S>& target) {
  Vector<S> q = target;
  std::string flaw;
  try {
    if (problem.nu() > 0) q = nearest_position(problem, target);
    for (const auto& redundant : problem.redundant)
      if (!value(redundant.constraint, problem.dimension, q).vanishes())
        flaw = "no consistent position was found near the given one; " + redundant.constraint.name +
               " contradicts the others";
  } catch (const InputError& error) {
    flaw = error.what();
  }
  if (!flaw.empty()) throw InputError(scene.name + ": " + flaw);
  return q;
}

/// Entries of v as decimals; those that are what they were keep their expressions.
template <Scalar S>
SceneVector as_expressions(const Vector<S>& v, Index offset, const SceneVector& were, const Constants& constants) {
  SceneVector result;
  for (std::size_t j = 0; j < were.size(); ++j) {
    const S& entry = v[offset + static_cast<Index>(j)];
    result.push_back(evaluate<S>(were[j], constants) == entry ? were[j] : Expression::parse(to_text(entry)));
  }
  return result;
}

}  // namespace

template <Scalar S>
Scene project(const Scene& scene) {
  Assembled<S> assembled = assemble<S>(scene, Consistency::unchecked);
  // What follows from other constraints is fulfilled with them, or contradicts them.
  set_aside(assembled.problem, find_independent<S>(assembled.problem, assembled.q0,
                                                   Vector<S>::Zero(assembled.problem.m()), own_precision<S>(scene)));
  const Problem<S>& problem = assembled.problem;
  const Vector<S> q = nearest_of(scene, problem, assembled.q0);
  StateEvaluator<S> point(problem);
  const Vector<S> p = point.tangential(q, assembled.p0);
  Vector<S> v(problem.m());
  problem.mass.velocity(lanes(p), lanes(v));

  Scene result = scene;
  const auto d = static_cast<std::size_t>(scene.dimension);
  Index offset = 0;
  const auto take = [&](const Vector<S>& from, SceneVector& to) {
    to = as_expressions(from, offset, to, scene.constants);
  };
  for (SceneBody& body : result.bodies) {
    take(q, body.position);
    take(v, body.velocity);
    take(p, body.momentum);
    offset += scene.dimension;
  }
  for (SceneRigidBody& body : result.rigid_bodies) {
    if (!body.fixed) {
      take(q, body.position);
      take(v, body.velocity);
      offset += scene.dimension;
    }
    // d_a' = omega x d_a gives omega = 1/2 sum d_a x d_a' for orthonormal directors, two in the plane or three.
    Vector<S> omega = Vector<S>::Zero(d == 2 ? 1 : 3);
    for (std::size_t a = 0; a < d; ++a) {
      take(q, body.directors[a]);
      if (d == 2)
        omega[0] += (q[offset] * v[offset + 1] - q[offset + 1] * v[offset]) / 2;
      else
        omega += q.template segment<3>(offset).cross(v.template segment<3>(offset)) / S(2);
      offset += scene.dimension;
    }
    body.angular_velocity = as_expressions(omega, 0, body.angular_velocity, scene.constants);
  }
  return result;
}

#define HBVM_DEFINE(S) template Scene project<S>(const Scene&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
