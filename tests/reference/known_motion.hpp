#pragma once

#include "hbvm/error.hpp"
#include "reference/closed_form/closed_form.hpp"

namespace hbvm::core {

/// The motion of a scene that has a closed form, at t.
inline ExactPoint known_motion(const char* scene_name, const Mpfr& t) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(scene_name));
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  if (!motion) throw Error(std::string("no closed form of ") + scene_name);
  return motion->at(t);
}

}  // namespace hbvm::core
