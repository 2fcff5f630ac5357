#pragma once

#include <array>
#include <string>
#include <vector>

#include "problem/space/displacement.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// What there is to draw of a scene: named places, and what joins them.
struct Sketch {
  struct Place {
    std::string name;
    Displacement<double> at;  ///< without blocks: fixed in space
    bool has_mass = true;
    double charge = 0;
    bool labelled = true;  ///< its name is one of the scene's; no helping point of a rigid body
  };
  enum class Joins { rod, spring, body };  ///< body: two places of one rigid body
  struct Link {
    std::size_t a, b;  ///< among the places
    Joins as;
  };

  int dimension = 0;
  std::vector<Place> places;
  std::vector<Link> links;

  /// The position of place i. \param q of scene's coordinates
  std::array<double, 3> position(std::size_t i, const std::vector<double>& q) const;
};

/// Bodies, points and rigid bodies of a scene, with its rods and those of its springs that it names. A rigid body has
/// its name at its centre of mass. Lines lead there from its reference point, and to its attachments, or to the ends of
/// its directors if it has none.
Sketch sketch(const Scene& scene);

}  // namespace hbvm::core
