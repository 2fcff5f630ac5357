#pragma once

#include <vector>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Mass, centre of mass c and second moment S about the reference point of a rigid body, in its own frame.
template <Scalar S>
struct MassDistribution {
  S mass;
  Vector<S> center;
  Matrix<S> second_moment;
};

/// A second moment that moves the body as the given one does and makes its mass matrix positive definite. In space it
/// is the given one. In the plane only the trace moves anything. Where the given matrix makes a mass matrix that is not
/// definite, it is another one of this trace. That has half the moment of inertia along each director.
/// \param fixed whether the reference point is
/// \throws InputError for one that no distribution of mass has: about the centre of mass, S - m c c^T is not positive
///         semidefinite, or its trace, which in the plane is all that counts,
///         not positive. In space also for a flat body, which has no thickness across itself
template <Scalar S>
Matrix<S> usable_second_moment(const MassDistribution<S>& of, bool fixed);

/// The principal moments of inertia about the centre of mass, ascending; in the plane the one about it.
std::vector<double> moments_of_inertia(const MassDistribution<double>& of);

}  // namespace hbvm::core
