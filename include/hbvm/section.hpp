#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/figure.hpp"
#include "hbvm/method.hpp"
#include "hbvm/number.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// Where many motions of one scene cross a surface: Poincare's section. The surface is where a value of the motion is
/// 0. Each crossing is a point with two other values as coordinates, found to the working precision.
struct SectionRequest {
  Scene scene;
  std::string plane;                         ///< a formula of what may be observed, as "a.x" or "a.x - b.x"
  std::string direction = "up";              ///< which crossings count: "up", "down" or "any"
  std::pair<std::string, std::string> axes;  ///< two formulas likewise
  /// What the starts differ by, each "NAME=FROM:TO:COUNT" or "NAME=A,B,C": constants of the scene, "a.mass" or
  /// "a.charge". All combinations are run. Without, the scene's own start alone.
  std::vector<std::string> starts = {};
  std::string method = usual_method;
  std::optional<Number> step = {};  ///< without, one that suits the time scale of the scene's own start
  Number until;
  std::string precision = "double";
  std::string solver = "auto";
  int jobs = 1;                                           ///< orbits side by side
  std::function<void(long done, long of)> progress = {};  ///< called now and then, with orbits
  std::stop_token stop = {};
};

/// A crossing: the time and the values of the axes, as decimal text of the working precision.
struct SectionPoint {
  std::string t, x, y;
};

/// One motion.
struct SectionOrbit {
  std::vector<std::string> start;  ///< the value of each name that starts differ by, exactly
  std::vector<double> start_near;  ///< and rounded
  std::string H, e_H;              ///< at the start, and by how much it was off at mesh points
  std::vector<SectionPoint> points;
  std::string failure;  ///< why there is no such start, or no motion from it, if there is none
  long grazes = 0;      ///< times at which the plane was touched and not crossed: they are no points
};

struct Section {
  std::string scene, method, step, until, precision, plane, direction;
  std::string title;               ///< of the scene, or its name
  std::vector<std::string> names;  ///< that starts differ by
  std::string x, y;                ///< the axes' formulas
  std::vector<SectionOrbit> orbits;
  std::string command;  ///< of the program, which makes the same
};

/// \throws InputError also if there is no motion from any of the starts; IntegrationError, Interrupted
Section section(const SectionRequest& request);

/// The points, a colour an orbit.
Figure figure_of(const Section& section);
/// A page of HTML that needs nothing besides itself. A click on a point shows its orbit: its other points, its start,
/// and the first part of its motion in space. \throws InputError, IntegrationError
std::string page_of(const Section& section, const SectionRequest& request);

std::string to_text(const Section& section);
std::string to_json(const Section& section);
/// A line a point: number of the orbit, its start, t, the axes.
std::string to_csv(const Section& section);

}  // namespace hbvm
