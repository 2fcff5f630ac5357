#pragma once

#include <array>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"
#include "run/recording.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {

/// What a picture of the motion shows.
struct Projection {
  int across = 0, up = 1;  ///< which coordinates: 0 is x
  long rods = 0;           ///< at how many times between start and end rods are drawn, too
  bool end = true;         ///< whether the scene is drawn as it is at the end
};

/// Paths of what has mass, with the scene as it was at the start, dashed, and is at the end.
Panel motion_panel(const Sketch& sketch, const Recording& recording, const Projection& projection);

/// What moves of a scene where its coordinates are these: bodies, rods and rigid bodies, in the colour of one curve.
/// They are dashed by it, too, so that what lies behind is seen.
void add_state(Panel& panel, const Sketch& sketch, const std::vector<double>& q, const Projection& projection,
               std::size_t colour);

/// Two observations that are drawn against each other.
using Portrait = std::array<std::string, 2>;

/// What there is to see of a run: its motion (in the plane, or along two axes), what it observes, its multipliers and
/// its errors. The axis of the errors is logarithmic. Observations of a portrait are drawn against each other, the
/// others against time.
/// \param linear_energy also show H - H_0 on a linear axis
Figure run_figure(const Sketch& sketch, const Recording& recording, const std::vector<Portrait>& portraits = {},
                  bool linear_energy = false);

/// The motion as pictures of one size one after another, at equal distances of time.
std::vector<Figure> motion_frames(const Sketch& sketch, const Recording& recording);
/// How many of them are shown a second.
constexpr int frames_a_second = 20;

/// The scene where its coordinates are these.
Figure scene_figure(const Sketch& sketch, const std::vector<double>& q);

}  // namespace hbvm::core
