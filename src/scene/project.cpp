#include "scene/project.hpp"

#include <algorithm>
#include <cmath>

#include "problem/constraint_gradient.hpp"
#include "problem/regularity.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/nearest_position.hpp"
#include "scene/own_precision.hpp"
#include "scene/turning.hpp"

namespace hbvm::core {
namespace {

constexpr const char* hold_of = "the hold of ";

/// Whether a constraint that was set aside is fulfilled. A coordinate that is held at 0, but for rounding, has no terms
/// of its own. It is measured by the others of its vector, by which it was rounded.
template <Scalar S>
bool is_fulfilled(const Constraint<S>& constraint, Index dimension, const Vector<S>& q) {
  ConstraintValue<S> at = value(constraint, dimension, q);
  if (constraint.name.starts_with(hold_of))
    for (const Index i : coordinates(constraint, dimension))
      raise_to(at.size, max_norm(Vector<S>(q.segment(i - i % dimension, dimension))));
  return at.vanishes();
}

/// nearest_position, which says of which scene it is.
template <Scalar S>
Vector<S> nearest_of(const Scene& scene, const Problem<S>& problem, const Vector<S>& target) {
  Vector<S> q = target;
  std::string flaw;
  try {
    if (problem.nu() > 0) q = nearest_position(problem, target);
    for (const auto& redundant : problem.redundant)
      if (!is_fulfilled(redundant.constraint, problem.dimension, q))
        flaw = "no consistent position was found near the given one; " + redundant.constraint.name +
               " contradicts the others";
  } catch (const InputError& error) {
    flaw = error.what();
  }
  if (!flaw.empty()) throw InputError(scene.name + ": " + flaw);
  return q;
}

/// A start that is made consistent.
template <Scalar S>
class Projection {
 public:
  Projection(const Scene& scene, const std::vector<HeldPart>& held)
      : scene_(scene), held_(held), assembled_(assemble<S>(scene, Consistency::unchecked)) {
    is_held_q_.resize(static_cast<std::size_t>(assembled_.problem.m()));
    is_held_v_ = is_held_q_;
    for (const HeldPart& part : held) {
      for (const Index i : part.positions) is_held_q_[static_cast<std::size_t>(i)] = true;
      for (const Index i : part.velocities) is_held_v_[static_cast<std::size_t>(i)] = true;
    }
    find_position();
    find_velocity();
  }

  Scene projected() const {
    Scene result = scene_;
    const auto d = static_cast<std::size_t>(scene_.dimension);
    Index offset = 0;
    for (SceneBody& body : result.bodies) {
      take(q_, is_held_q_, offset, body.position);
      take(v_, is_held_v_, offset, body.velocity);
      take(p_, {}, offset, body.momentum);
      offset += scene_.dimension;
    }
    for (SceneRigidBody& body : result.rigid_bodies) {
      if (!body.fixed) {
        take(q_, is_held_q_, offset, body.position);
        take(v_, is_held_v_, offset, body.velocity);
        offset += scene_.dimension;
      }
      const bool turns_as_it_did = is_held_v_[static_cast<std::size_t>(offset)];
      const Vector<S> omega = angular_velocity(scene_.dimension, offset, q_, v_);
      for (std::size_t a = 0; a < d; ++a) {
        take(q_, is_held_q_, offset, body.directors[a]);
        offset += scene_.dimension;
      }
      if (!turns_as_it_did) take(omega, {}, 0, body.angular_velocity);
    }
    return result;
  }

 private:
  void find_position() {
    Problem<S> problem = assembled_.problem;
    for (const HeldPart& part : held_)
      for (const Index i : part.positions) hold(problem, part, i, assembled_.q0[i]);
    set_aside(problem, independence_of(problem, assembled_.q0));
    q_ = nearest_of(scene_, problem, assembled_.q0);
  }

  /// The momentum nearest to the given one, in the metric M^-1, whose velocity is tangential but for what is held.
  void find_velocity() {
    Problem<S> problem = assembled_.problem;
    const Index nu = problem.nu();
    Vector<S> wanted(problem.m());
    problem.mass.velocity(lanes(assembled_.p0), lanes(wanted));
    turn_with_position(wanted);
    std::vector<Index> coordinates;
    for (const HeldPart& part : held_)
      for (const Index i : part.velocities) {
        hold(problem, part, i, S(0));
        coordinates.push_back(i);
      }
    const Independence<S> independence = independence_of(problem, q_);
    set_aside(problem, independence);
    Vector<S> rates = Vector<S>::Zero(problem.nu());
    for (std::size_t n = 0; n < independence.kept.size(); ++n)
      if (const Index a = independence.kept[n]; a >= nu)
        rates[static_cast<Index>(n)] = wanted[coordinates[static_cast<std::size_t>(a - nu)]];
    p_ = StateEvaluator<S>(problem).with_rates(q_, assembled_.p0, rates);
    v_ = Vector<S>(problem.m());
    problem.mass.velocity(lanes(p_), lanes(v_));
    expect_held(wanted, independence);
  }

  /// What was set aside must agree with the rest.
  void expect_held(const Vector<S>& wanted, const Independence<S>& independence) const {
    using std::sqrt;
    const Problem<S>& whole = assembled_.problem;
    const S tolerance = S(sqrt(epsilon<S>())) * (max_norm(wanted) + max_norm(v_));
    for (const HeldPart& part : held_)
      for (const Index i : part.velocities)
        if (magnitude(S(v_[i] - wanted[i])) > tolerance)
          throw InputError(scene_.name + ": " + part.name + " cannot be held: the constraints make a velocity of " +
                           to_scientific(wanted[i], 3) + " one of " + to_scientific(v_[i], 3));
    ConstraintGradient<S> gradient(whole, 1);
    gradient.update(lanes(q_));
    for (const Dependence<S>& dependence : independence.redundant) {
      if (dependence.constraint >= whole.nu()) continue;
      const Constraint<S>& constraint = whole.constraints[static_cast<std::size_t>(dependence.constraint)];
      S rate;
      gradient.transposed_times(dependence.constraint, lanes(v_), &rate);
      if (magnitude(rate) > tolerance * gradient_size(constraint, whole.dimension, q_))
        throw InputError(scene_.name + ": the velocities that are held contradict " + constraint.name);
    }
  }

  /// Those that are independent at q. What follows from the others is fulfilled with them, or contradicts them.
  Independence<S> independence_of(const Problem<S>& problem, const Vector<S>& q) const {
    return find_independent<S>(problem, q, Vector<S>::Zero(problem.m()), own_precision<S>(scene_));
  }

  static void hold(Problem<S>& problem, const HeldPart& part, Index i, const S& at) {
    const Index d = problem.dimension;
    problem.constraints.push_back(
        {hold_of + part.name, Plane<S>{{i - i % d}, Vector<S>(Vector<S>::Unit(d, i % d)), at}});
  }

  /// Directors whose turning is held turn at q as the body does.
  void turn_with_position(Vector<S>& v) const {
    const Index d = scene_.dimension;
    for (const HeldPart& part : held_) {
      if (part.turning.empty()) continue;
      const Index first = part.velocities.front();
      const auto body = std::find_if(scene_.rigid_bodies.begin(), scene_.rigid_bodies.end(),
                                     [&](const SceneRigidBody& one) { return one.name == part.turning; });
      Vector<S> omega(static_cast<Index>(body->angular_velocity.size()));
      for (Index i = 0; i < omega.size(); ++i)
        omega[i] = evaluate<S>(body->angular_velocity[static_cast<std::size_t>(i)], scene_.constants);
      for (const Index i : part.velocities)
        if ((i - first) % d == 0) v.segment(i, d) = turned(omega, Vector<S>(q_.segment(i, d)));
    }
  }

  /// Entries as decimals; those that are held, or are what they were, keep their expressions.
  void take(const Vector<S>& from, const std::vector<bool>& held, Index offset, SceneVector& entries) const {
    for (std::size_t j = 0; j < entries.size(); ++j) {
      const Index i = offset + static_cast<Index>(j);
      if (!held.empty() && held[static_cast<std::size_t>(i)]) continue;
      if (evaluate<S>(entries[j], scene_.constants) != from[i]) entries[j] = Expression::parse(to_text(from[i]));
    }
  }

  const Scene& scene_;
  const std::vector<HeldPart>& held_;
  Assembled<S> assembled_;
  std::vector<bool> is_held_q_, is_held_v_;
  Vector<S> q_, v_, p_;
};

}  // namespace

template <Scalar S>
Scene project(const Scene& scene, const std::vector<HeldPart>& held) {
  return Projection<S>(scene, held).projected();
}

#define HBVM_DEFINE(S) template Scene project<S>(const Scene&, const std::vector<HeldPart>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
