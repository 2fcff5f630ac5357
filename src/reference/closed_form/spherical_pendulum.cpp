#include <algorithm>

#include "reference/closed_form/cubic_motion.hpp"
#include "reference/closed_form/elliptic.hpp"
#include "reference/closed_form/recognition.hpp"

namespace hbvm::core {
namespace {

/// With length 1 and z upwards, g the acceleration, E = v^2/2 + g z and h = x y' - y x':
///
///     z'^2 = 2 (E - g z)(1 - z^2) - h^2 = 2 g (z - z_1)(z - z_2)(z - z_3),  -1 < z_1 <= z <= z_2 < 1 < z_3,
///
/// as CubicMotion solves it, and the azimuth grows by h/(1 - z^2) = h/2 (1/(1 + z) + 1/(1 - z)). In the conical
/// pendulum, the paper's (63)-(65) for one, z_1 = z_2.
class SphericalPendulum : public ClosedForm {
 public:
  SphericalPendulum(const Recognition& content, const OnSphere& sphere, const Vector<Mpfr>& down, const Mpfr& force)
      : ClosedForm(content.scene.problem), sphere_(sphere), up_(-down) {
    Vector<Mpfr> arm = content.scene.q0 - sphere.pivot;
    arm /= norm(arm);
    Vector<Mpfr> v = content.scene.p0 / (sphere.mass * sphere.radius);
    v -= inner(v, arm) * arm;
    const Mpfr z = inner(arm, up_), g = force / (sphere.mass * sphere.radius), E = inner(v, v) / 2 + g * z;
    h_ = inner(up_, cross(arm, v));
    // z'^2 / (2 g) = z^3 - E/g z^2 - z + (2 E - h^2)/(2 g)
    motion_.emplace(CubicRoots::of(Mpfr(-E / g), Mpfr(-1), Mpfr((2 * E - h_ * h_) / (2 * g))), Mpfr(2 * g), z,
                    inner(v, up_));
    first_ = arm - z * up_;
    first_ /= norm(first_);
    second_ = cross(up_, first_);
  }
  std::string name() const override { return "spherical pendulum (elliptic integrals)"; }

 private:
  State state(const Mpfr& t) const override {
    const CubicMotion::Place now = motion_->at(t);
    const CubicMotion::Integrals integrals = motion_->integrals(t);
    const Mpfr angle = h_ / 2 * (integrals.above + integrals.below);
    const Mpfr square = now.above * now.below, radius = sqrt(square), turning = h_ / square,
               growing = -now.z * now.rate / radius;
    const Mpfr cosine = cos(angle), sine = sin(angle);
    const Vector<Mpfr> outwards = cosine * first_ + sine * second_, onwards = cosine * second_ - sine * first_;
    return {sphere_.pivot + sphere_.radius * (radius * outwards + now.z * up_),
            sphere_.mass * sphere_.radius * (growing * outwards + radius * turning * onwards + now.rate * up_)};
  }

  OnSphere sphere_;
  Vector<Mpfr> up_, first_, second_;
  Mpfr h_;
  std::optional<CubicMotion> motion_;
};

}  // namespace

std::optional<Vector<Mpfr>> plane_of_motion(const Recognition& content, const OnSphere& sphere,
                                            const Vector<Mpfr>& down) {
  const Vector<Mpfr> arm = content.scene.q0 - sphere.pivot, &p = content.scene.p0;
  const Vector<Mpfr> x = arm - inner(arm, down) * down, y = p - inner(p, down) * down;
  const Mpfr across = norm(x), speed = norm(y);
  // What rounding makes of an angular momentum 0, from positions and momenta each component of which is rounded.
  constexpr int units = 64;
  Mpfr terms = 0;
  for (Index j = 0; j < 3; ++j)
    for (const Index k : {(j + 1) % 3, (j + 2) % 3})
      terms +=
          magnitude(down[3 - j - k]) * (magnitude(content.scene.q0[j]) + magnitude(sphere.pivot[j])) * magnitude(p[k]);
  if (magnitude(inner(down, cross(arm, p))) > units * content.round_off * terms) return std::nullopt;
  // The longer of the two tells the plane.
  const Mpfr lean = across / norm(arm), course = speed == 0 ? Mpfr(0) : Mpfr(speed / norm(p));
  if (lean >= course && lean > 0) return Vector<Mpfr>(x / across);
  if (course > 0) return Vector<Mpfr>(y / speed);
  Index least = 0;
  for (Index j = 1; j < 3; ++j)
    if (magnitude(down[j]) < magnitude(down[least])) least = j;
  const Vector<Mpfr> any = cross(down, Vector<Mpfr>::Unit(3, least));
  return Vector<Mpfr>(any / norm(any));
}

std::unique_ptr<ClosedForm> spherical_pendulum_of(const Recognition& content) {
  const std::optional<OnSphere> sphere = content.on_sphere();
  if (!sphere || content.dimension != 3) return nullptr;
  const Vector<Mpfr> force = content.constant_force();
  const Mpfr strength = norm(force);
  if (strength == 0) return nullptr;
  const Vector<Mpfr> down = force / strength;
  if (plane_of_motion(content, *sphere, down)) return nullptr;
  return std::make_unique<SphericalPendulum>(content, *sphere, down, strength);
}

}  // namespace hbvm::core
