#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problem/problem.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// A state as it is observed: p and the multipliers of all constraints are those of the output state.
template <Scalar S>
struct SeenState {
  S t = 0;
  Vector<S> q, p, v, lambda;  ///< v = M^-1 p
  S H = 0, T = 0;             ///< the energy, and its kinetic part 1/2 p^T v
};

/// A number that a state has.
template <Scalar S>
struct SeenQuantity {
  std::function<S(const SeenState<S>&)> value;
  /// Of an angle that goes on over full turns: how fast it grows. Its value is in (-pi, pi].
  std::function<S(const SeenState<S>&)> rate = {};
};

/// What the names in an observation stand for:
///
///     | name                           | value                                                                       |
///     |--------------------------------|-----------------------------------------------------------------------------|
///     | t                              | the time                                                                    |
///     | a.x, a.vx, a.px                | position, velocity and momentum of a body; of a point or attachment no p    |
///     | x(a), vx(a), px(a)             | the same of a name that is no word                                          |
///     | distance(a, b), speed(a)       | of two places, of one                                                       |
///     | angle(a.d1), angle(a, b)       | in the plane, against the x axis: of a director, of the way from a to b     |
///     | angle(a.d1, b.d1)              | from the first direction to the second; in space in [0, pi]                 |
///     | rate(...)                      | how fast such an angle of the plane grows                                   |
///     | omega(a), omega(a, a.d3)       | angular velocity; in space its component along a direction                  |
///     | kinetic(a), kinetic()          | energy of a body, of all                                                    |
///     | potential(), energy()          | -U, and H                                                                   |
///     | tension(a, b)                  | of the rods between two places; positive if they pull                       |
///     | force(a, b, x)                 | of rods and joints between them, on a, along a direction                    |
///     | slide(a, b)                    | how far b is from a along the prismatic or cylindrical joint between them   |
///     | torque(a, b), torque(a, b, z)  | likewise the moment about a on the rigid body that a is on                  |
///     | work(a), power(a)              | of an effect, a constraint or a moving point; of all without a              |
///     | force(a, x)                    | on a rigid body, of what holds it where it is fixed                         |
///
/// A direction is x, y or z of space, or a director.
template <Scalar S>
class SeenQuantities {
 public:
  /// Scene and problem must outlive it, the problem also the quantities.
  SeenQuantities(const Scene& scene, const Problem<S>& problem);
  ~SeenQuantities();
  SeenQuantities(const SeenQuantities&) = delete;
  SeenQuantities& operator=(const SeenQuantities&) = delete;

  /// \throws InputError, with what there is, for a name that stands for nothing
  SeenQuantity<S> named(const std::string& name) const;

 private:
  class Names;
  std::unique_ptr<const Names> names_;
};

}  // namespace hbvm::core
