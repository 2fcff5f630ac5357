#include "hbvm/scene/project.hpp"

#include <Eigen/Geometry>

#include "hbvm/linear/lu.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/problem/regularity.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {
namespace {

[[noreturn]] void throw_no_position(const std::string& name) {
  throw InputError(name +
                   ": no consistent position was found near the given one; the constraints may contradict one another");
}

/// q with g(q) = 0 nearest to `target` in the metric M. Each sweep minimises the distance under the constraints
/// linearised at the last q: q = target - M^-1 grad g mu with
/// grad g^T M^-1 grad g mu = g(q) + grad g^T (target - q).
template <Scalar S>
Vector<S> nearest_position(const Problem<S>& problem, const Vector<S>& target, const std::string& name) {
  const Index nu = problem.nu();
  Point<S> point(problem);
  ConstraintGradient<S> gradient(problem, 1);
  Lu<S> gram;
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
    gradient.gram(gram_matrix);
    gram.set(gram_matrix);
    if (!gram.factor()) break;
    gram.solve(mu);
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
  throw_no_position(name);
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
  set_aside(assembled.problem,
            find_independent<S>(assembled.problem, assembled.q0, Vector<S>::Zero(assembled.problem.m())));
  const Problem<S>& problem = assembled.problem;
  const Vector<S> q = problem.nu() > 0 ? nearest_position(problem, assembled.q0, scene.name) : assembled.q0;
  for (const auto& redundant : problem.redundant) {
    if (!value(redundant.constraint, problem.dimension, q).vanishes()) throw_no_position(scene.name);
  }
  Point<S> point(problem);
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

}  // namespace hbvm
