#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "linear/norm.hpp"
#include "reference/closed_form/closed_form.hpp"

namespace hbvm::core {

/// One body, pair or group on which an effect acts.
struct Acting {
  const EffectTerm<Mpfr>* term;
  Index instance;

  /// Its only displacement, or the first.
  const Displacement<Mpfr>& displacement() const { return term->displacement(instance, 0); }
  /// Its displacements at q, one after the other.
  Vector<Mpfr> place(const Vector<Mpfr>& q, Index dimension) const { return displaced(*term, instance, dimension, q); }
  /// f(i, coordinate, weight) for every coordinate that component i of the displacements is made of.
  template <class F>
  void for_each_coordinate(Index dimension, F f) const {
    for (Index i = 0; i < term->arguments * dimension; ++i)
      for (const auto& block : term->displacement(instance, i / dimension).blocks)
        f(i, block.offset + i % dimension, block.weight);
  }
  /// dU/dx and d2U/dx2 at these displacements.
  Vector<Mpfr> gradient(const Vector<Mpfr>& x) const;
  Matrix<Mpfr> hessian(const Vector<Mpfr>& x) const;
};

/// A body on a sphere about a fixed point; in the plane, on a circle.
struct OnSphere {
  Mpfr mass, radius;
  Vector<Mpfr> pivot;
};

/// What a scene consists of, for recognising closed forms, in the digits of the scope.
struct Recognition {
  /// \param round_off the epsilon of the digits in which the scene was assembled
  Recognition(const Assembled<Mpfr>& assembled, const Mpfr& round_off);

  const Assembled<Mpfr>& scene;
  Mpfr round_off;
  Index dimension;
  std::vector<Acting> acting;  ///< effects a factor of which is 0 do not

  /// The mass of the body at this coordinate, if it is one number.
  std::optional<Mpfr> mass_at(Index offset) const;
  bool is_constant_force() const;
  /// grad U, if is_constant_force().
  Vector<Mpfr> constant_force() const;
  /// One body, one constraint that is a sphere, a constant force.
  std::optional<OnSphere> on_sphere() const;
};

/// Each the motion of one kind, or none.
std::unique_ptr<ClosedForm> oscillator_of(const Recognition& content);
std::unique_ptr<ClosedForm> kepler_of(const Recognition& content);
std::unique_ptr<ClosedForm> pendulum_of(const Recognition& content);
std::unique_ptr<ClosedForm> spherical_pendulum_of(const Recognition& content);

std::unique_ptr<ClosedForm> free_rigid_body_of(const Recognition& content);
std::unique_ptr<ClosedForm> symmetric_top_of(const Recognition& content);

/// In space, a unit vector across the force in the plane in which a pendulum stays. There is none if it leaves every
/// plane by more than rounding.
std::optional<Vector<Mpfr>> plane_of_motion(const Recognition& content, const OnSphere& sphere,
                                            const Vector<Mpfr>& down);

/// Vectors of the plane and of space.
Vector<Mpfr> cross(const Vector<Mpfr>& a, const Vector<Mpfr>& b);
Matrix<Mpfr> multiplied(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b);

}  // namespace hbvm::core
