#pragma once

#include "scene/scene.hpp"
#include "scene/solid.hpp"

namespace hbvm::core {

/// What a rigid body looks like, in its frame and from its reference point. It is the body's `shape`. Without one it is
/// the solid box that has the body's mass and moments of inertia about its centre of mass. If two moments are equal it
/// is a cylinder. In the plane it is flat, a rectangle or a disc. What is thin is drawn with some thickness.
/// \param extent of the scene around it: what would be much larger is drawn smaller; 0 if there is none
Solid body_shape(const SceneRigidBody& body, const Constants& constants, double extent);

/// The lengths of the edges of the homogeneous box with these integrals of x^2 dm, y^2 dm, z^2 dm over its mass.
Solid::Point edges_of_box(const Solid::Point& mean_squares);

}  // namespace hbvm::core
