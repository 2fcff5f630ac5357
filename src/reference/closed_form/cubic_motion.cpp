#include "reference/closed_form/cubic_motion.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

Mpfr root_of_part(const Mpfr& part, const Mpfr& whole) { return part > 0 ? Mpfr(sqrt(Mpfr(part / whole))) : Mpfr(0); }

}  // namespace

CubicRoots CubicRoots::of(const Mpfr& a, const Mpfr& b, const Mpfr& c) {
  // Viete: with z = y - a/3 it is y^3 + p y + q, and y = r cos(angle).
  const Mpfr third = a / 3, p = b - a * third, q = c + third * (2 * third * third - b);
  const Mpfr r = 2 * sqrt(std::max(Mpfr(0), Mpfr(-p / 3)));
  if (r == 0) return {-third, -third, -third};
  const Mpfr cosine = std::clamp(Mpfr(3 * q / (p * r)), Mpfr(-1), Mpfr(1)), pi = 4 * atan(Mpfr(1)),
             angle = acos(cosine) / 3;
  return {r * cos(Mpfr(angle + 2 * pi / 3)) - third, r * cos(Mpfr(angle - 2 * pi / 3)) - third, r * cos(angle) - third};
}

CubicMotion::CubicMotion(const CubicRoots& roots, const Mpfr& f, const Mpfr& z, const Mpfr& rate)
    : roots_(roots),
      omega_(sqrt(Mpfr(f * (roots.z3 - roots.z1))) / 2),
      m_((roots.z2 - roots.z1) / (roots.z3 - roots.z1)),
      m1_((roots.z3 - roots.z2) / (roots.z3 - roots.z1)),
      start_{root_of_part(z - roots.z1, roots.z3 - roots.z1), root_of_part(roots.z2 - z, roots.z3 - roots.z1),
             root_of_part(roots.z3 - z, roots.z3 - roots.z1)},
      above_(Mpfr(-(roots.z2 - roots.z1) / (1 + roots.z1)), Mpfr((1 + roots.z2) / (1 + roots.z1)), m1_),
      below_(Mpfr((roots.z2 - roots.z1) / (1 - roots.z1)), Mpfr((1 - roots.z2) / (1 - roots.z1)), m1_) {
  if (rate < 0) start_.kappa_sn = -start_.kappa_sn;
  const Mpfr phi = atan2(start_.kappa_sn, start_.kappa_cn);
  u0_ = elliptic_first(phi, m1_);
  above_before_ = above_.at(phi);
  below_before_ = below_.at(phi);
}

CubicMotion::Place CubicMotion::at(const Mpfr& t) const {
  const JacobiMultiples now = advanced(start_, m_, m1_, Mpfr(omega_ * t));
  const Mpfr range = roots_.z3 - roots_.z1, up = range * now.kappa_sn * now.kappa_sn,
             down = range * now.kappa_cn * now.kappa_cn;
  return {roots_.z1 + up, 2 * range * omega_ * now.kappa_sn * now.kappa_cn * now.dn, 1 + roots_.z1 + up,
          1 - roots_.z2 + down};
}

CubicMotion::Integrals CubicMotion::integrals(const Mpfr& t) const {
  const Mpfr phi = jacobi_amplitude(Mpfr(u0_ + omega_ * t), m_, m1_);
  return {(t + (above_.at(phi) - above_before_) / omega_) / (1 + roots_.z1),
          (t + (below_.at(phi) - below_before_) / omega_) / (1 - roots_.z1)};
}

}  // namespace hbvm::core
