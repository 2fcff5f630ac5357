#pragma once

#include <memory>
#include <string>

#include "scene/assemble.hpp"

namespace hbvm::core {

/// A state of an exact motion: p tangential, lambda the multiplier of Theorem 1.
struct ExactPoint {
  Vector<Mpfr> q, p, lambda;
};

/// A motion that is known in closed form, from its start on. It computes with more digits than it was made with, so
/// that what cancels in a formula is not missed. at() gives the motion from the start as it was rounded, to the last
/// digits of the scope.
class ClosedForm {
 public:
  virtual ~ClosedForm() = default;

  /// What it solves and by what: "simple pendulum (Jacobi's elliptic functions)".
  virtual std::string name() const = 0;
  /// The motion at any time, before the start as well.
  /// \throws IntegrationError where the motion has ended
  ExactPoint at(const Mpfr& t) const;
  /// Digits it computes with.
  unsigned working_digits() const { return digits_; }

 protected:
  struct State {
    Vector<Mpfr> q, p;
  };
  /// Computes in the digits of the scope. The problem must outlive it.
  explicit ClosedForm(const Problem<Mpfr>& problem) : problem_(problem), digits_(Mpfr::thread_default_precision()) {}
  const Problem<Mpfr>& problem() const { return problem_; }

 private:
  virtual State state(const Mpfr& t) const = 0;

  const Problem<Mpfr>& problem_;
  unsigned digits_;
};

/// The closed form of a motion, or none. It is recognised from masses, constraints, effects and start: nothing that
/// acts may be left over. The scene must outlive it.
///
/// - motion under constant forces, harmonic oscillators: no constraints, U of degree 2;
/// - Kepler's problem: a body and a centre, or two bodies;
/// - pendulum, spherical pendulum, circle: a body at a constant distance from a point, under a constant force;
/// - free rigid body, of points joined by rods or of directors: held at its middle or at no point;
/// - symmetric heavy top: a rigid body with two equal moments, held at a point of its axis, under a constant force.
std::unique_ptr<ClosedForm> closed_form_of(const Assembled<Mpfr>& scene);

}  // namespace hbvm::core
