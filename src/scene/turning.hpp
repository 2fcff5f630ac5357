#pragma once

#include <Eigen/Geometry>

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// omega x v, the rate of a vector that turns at omega; in the plane omega is one number.
template <Scalar S>
Vector<S> turned(const Vector<S>& omega, const Vector<S>& v) {
  if (v.size() == 3) return omega.template head<3>().cross(v.template head<3>());
  Vector<S> result(2);
  result << -omega[0] * v[1], omega[0] * v[0];
  return result;
}

/// The angular velocity of d orthonormal directors, which stand one after another from `offset` on in q, and their
/// rates in v. Directors with d_a' = omega x d_a have it as 1/2 sum d_a x d_a'.
template <Scalar S>
Vector<S> angular_velocity(Index d, Index offset, const Vector<S>& q, const Vector<S>& v) {
  Vector<S> omega = Vector<S>::Zero(d == 2 ? 1 : 3);
  for (Index a = 0; a < d; ++a, offset += d) {
    if (d == 2)
      omega[0] += (q[offset] * v[offset + 1] - q[offset + 1] * v[offset]) / 2;
    else
      omega += q.template segment<3>(offset).cross(v.template segment<3>(offset)) / S(2);
  }
  return omega;
}

}  // namespace hbvm::core
