#include "reference/closed_form/elliptic.hpp"
#include "reference/closed_form/recognition.hpp"

namespace hbvm::core {
namespace {

/// Without a force: a circle at constant speed.
class CircularMotion : public ClosedForm {
 public:
  CircularMotion(const Recognition& content, const OnSphere& sphere)
      : ClosedForm(content.scene.problem), sphere_(sphere) {
    arm_ = content.scene.q0 - sphere.pivot;
    arm_ *= sphere.radius / norm(arm_);
    momentum_ = content.scene.p0 - inner(content.scene.p0, arm_) / inner(arm_, arm_) * arm_;
    rate_ = norm(momentum_) / (sphere.mass * sphere.radius);
  }
  std::string name() const override { return "uniform circular motion"; }

 private:
  State state(const Mpfr& t) const override {
    const Mpfr angle = rate_ * t, cosine = cos(angle), sine = sin(angle);
    State now{sphere_.pivot + cosine * arm_, cosine * momentum_};
    if (rate_ == 0) return now;
    now.q += sine / (rate_ * sphere_.mass) * momentum_;
    now.p -= sine * rate_ * sphere_.mass * arm_;
    return now;
  }

  OnSphere sphere_;
  Vector<Mpfr> arm_, momentum_;
  Mpfr rate_;
};

/// In the plane of two unit vectors, `down` along the force and `across`: with theta from down, theta'' = -omega^2 sin
/// theta. S = sin(theta/2), C = theta'/(2 omega) and D = cos(theta/2) are kappa sn, kappa cn and dn of omega t + u_0.
/// kappa^2 = S^2 + C^2 is below 1 if the pendulum swings and above 1 if it turns round. It is 1/4 in the paper's
/// (58)-(60).
class Pendulum : public ClosedForm {
 public:
  Pendulum(const Recognition& content, const OnSphere& sphere, const Vector<Mpfr>& down, const Vector<Mpfr>& across,
           const Mpfr& force)
      : ClosedForm(content.scene.problem), sphere_(sphere), down_(down), across_(across) {
    omega_ = sqrt(Mpfr(force / (sphere.mass * sphere.radius)));
    const Vector<Mpfr> arm = content.scene.q0 - sphere.pivot;
    // Of the half angle without the angle: at rest above, and below, nothing is left of rounding that would grow.
    const Mpfr out = inner(arm, across), below = inner(arm, down), length = sqrt(Mpfr(out * out + below * below)),
               sine = out / length, cosine = below / length;
    const Mpfr greater = sqrt(Mpfr((1 + magnitude(cosine)) / 2)), less = sine / (2 * greater);
    const Vector<Mpfr> forward = cosine * across - sine * down;
    start_ = {cosine < 0 ? greater : less,
              inner(content.scene.p0, forward) / (2 * omega_ * sphere.mass * sphere.radius),
              cosine < 0 ? less : greater};
  }
  std::string name() const override { return "simple pendulum (Jacobi's elliptic functions)"; }

 private:
  State state(const Mpfr& t) const override {
    const auto& [S0, C0, D0] = start_;
    const auto [S, C, D] = advanced(start_, Mpfr(S0 * S0 + C0 * C0), Mpfr(D0 * D0 - C0 * C0), Mpfr(omega_ * t));
    const Mpfr sine = 2 * S * D, cosine = D * D - S * S;
    return {sphere_.pivot + sphere_.radius * (sine * across_ + cosine * down_),
            2 * omega_ * C * sphere_.mass * sphere_.radius * (cosine * across_ - sine * down_)};
  }

  OnSphere sphere_;
  Vector<Mpfr> down_, across_;
  Mpfr omega_;
  JacobiMultiples start_;
};

}  // namespace

std::unique_ptr<ClosedForm> pendulum_of(const Recognition& content) {
  const std::optional<OnSphere> sphere = content.on_sphere();
  if (!sphere) return nullptr;
  const Vector<Mpfr> force = content.constant_force();
  const Mpfr strength = norm(force);
  if (strength == 0) return std::make_unique<CircularMotion>(content, *sphere);
  const Vector<Mpfr> down = force / strength;
  Vector<Mpfr> across(content.dimension);
  if (content.dimension == 2) {
    across << -down[1], down[0];
  } else {
    const std::optional<Vector<Mpfr>> plane = plane_of_motion(content, *sphere, down);
    if (!plane) return nullptr;
    across = *plane;
  }
  return std::make_unique<Pendulum>(content, *sphere, down, across, strength);
}

}  // namespace hbvm::core
