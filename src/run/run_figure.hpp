#pragma once

#include "hbvm/figure.hpp"
#include "run/recording.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {

/// What a picture of the motion shows.
struct Projection {
  int across = 0, up = 1;  ///< which coordinates: 0 is x
  long rods = 0;           ///< at how many times between start and end rods are drawn, too
};

/// Paths of what has mass, with the scene as it was at the start, dashed, and is at the end.
Panel motion_panel(const Sketch& sketch, const Recording& recording, const Projection& projection);

/// What there is to see of a run: its motion (in the plane, or along two axes), its multipliers and its errors. The
/// axis of the errors is logarithmic.
Figure run_figure(const Sketch& sketch, const Recording& recording);

/// The scene where its coordinates are these.
Figure scene_figure(const Sketch& sketch, const std::vector<double>& q);

}  // namespace hbvm::core
