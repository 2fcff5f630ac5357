#pragma once

#include <memory>

#include "integrate/seen_quantity.hpp"
#include "problem/constraint_gradient.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// The force on a rigid body that holds the point it is `fixed_at`, by its balance of momentum:
///
///     m (sum_i c_i d_i)'' = F + sum of what the effects and the constraints do to it,
///
/// where d_i are its directors and c is its centre of mass in its frame. What effects and constraints do to a body is
/// the derivative by a translation of it. It is told by the same scene with the body free to move.
template <Scalar S>
class SupportForce {
 public:
  /// \param body of the scene, with a fixed point. The problem must outlive it.
  SupportForce(const Scene& scene, const Problem<S>& problem, const SceneRigidBody& body);
  SupportForce(const SupportForce&) = delete;
  SupportForce& operator=(const SupportForce&) = delete;

  Vector<S> operator()(const SeenState<S>& state);

 private:
  const Problem<S>& problem_;
  Problem<S> free_;
  Index origin_ = 0;                // of the reference point among the coordinates of the free body
  Vector<S> reference_, center_;    // the fixed point, and m c
  std::vector<Index> multipliers_;  // of the constraints of the free body: their numbers here, or -1
  std::unique_ptr<PotentialEvaluator<S>> potential_;
  std::unique_ptr<ConstraintGradient<S>> gradient_;
};

}  // namespace hbvm::core
