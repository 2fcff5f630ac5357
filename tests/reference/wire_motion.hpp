#pragma once

#include <cmath>
#include <string>

#include "hbvm/error.hpp"
#include "linear/matrix.hpp"

namespace hbvm::core {

/// The motion of a bead of mass 1 on a wire whose height z over the way along it is known.
struct WireMotion {
  Vector<Mpfr> q, p, lambda;
};

/// The motion of two scenes. In bead_on_helix z = 3 t/2 - t^2/4, and in bead_on_cycloid z = (1/4)/w sin(w t) with w^2 =
/// 4/17. The multiplier lambda follows from p' = F - grad g lambda, of which the two constraints for x and y have one
/// component each.
inline WireMotion wire_motion(const std::string& scene, const Mpfr& t) {
  WireMotion result{Vector<Mpfr>(3), Vector<Mpfr>(3), Vector<Mpfr>(2)};
  Mpfr x, dx, ddx, y, dy, ddy, z, dz, ddz, F_y = 0;
  if (scene == "bead_on_helix") {
    z = 3 * t / 2 - t * t / 4;
    dz = (3 - t) / 2;
    ddz = Mpfr(-1) / 2;
    x = cos(z);
    y = sin(z);
    dx = -y * dz;
    dy = x * dz;
    ddx = -x * dz * dz - y * ddz;
    ddy = -y * dz * dz + x * ddz;
  } else if (scene == "bead_on_cycloid") {
    const Mpfr w2 = Mpfr(4) / 17, w = sqrt(w2);
    z = sin(Mpfr(w * t)) / (4 * w);
    dz = cos(Mpfr(w * t)) / 4;
    ddz = -w2 * z;
    const Mpfr u = asin(z), cosine = sqrt(Mpfr(1 - z * z));
    x = 2 * u + sin(Mpfr(2 * u));
    dx = 4 * cosine * dz;  // dx/dz = (2 + 2 cos 2u)/cos u
    ddx = 4 * (cosine * ddz - z * dz * dz / cosine);
    y = 2 * z * z;
    dy = 4 * z * dz;
    ddy = 4 * (dz * dz + z * ddz);
    F_y = -1;
  } else {
    throw Error("no wire is known of " + scene);
  }
  result.q << x, y, z;
  result.p << dx, dy, dz;
  result.lambda << -ddx, F_y - ddy;
  return result;
}

}  // namespace hbvm::core
