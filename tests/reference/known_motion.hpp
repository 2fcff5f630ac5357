#pragma once

#include <optional>

#include "hbvm/error.hpp"
#include "reference/closed_form/closed_form.hpp"

namespace hbvm::core {

/// The motion of a bead of mass 1 on a wire, whose height z over the way along it is known; nothing of another scene.
/// In bead_on_helix z = 3 t/2 - t^2/4, and in bead_on_cycloid z = (1/4)/w sin(w t) with w^2 = 4/17. The multiplier
/// lambda follows from p' = F - grad g lambda, of which the two constraints for x and y have one component each.
inline std::optional<ExactPoint> wire_motion(const std::string& scene, const Mpfr& t) {
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
    return {};
  }
  return ExactPoint{Vector<Mpfr>{{x, y, z}}, Vector<Mpfr>{{dx, dy, dz}}, Vector<Mpfr>{{Mpfr(-ddx), Mpfr(F_y - ddy)}}};
}

/// The motion of a scene on such a wire, or of one that has a closed form, at t.
inline ExactPoint known_motion(const std::string& scene_name, const Mpfr& t) {
  if (const auto on_a_wire = wire_motion(scene_name, t)) return *on_a_wire;
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(scene_name));
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  if (!motion) throw Error("no closed form of " + scene_name);
  return motion->at(t);
}

}  // namespace hbvm::core
