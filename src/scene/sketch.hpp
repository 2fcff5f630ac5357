#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "problem/space/displacement.hpp"
#include "scene/held_on.hpp"
#include "scene/scene.hpp"
#include "scene/solid.hpp"

namespace hbvm::core {

/// What there is to draw of a scene: named places, what joins them, rigid bodies, and what bodies are held on.
struct Sketch {
  struct Place {
    enum class Mark { dot, joint, none };
    std::string name;
    Displacement<double> at;  ///< without blocks: fixed in space
    bool has_mass = true;
    double charge = 0;
    bool labelled = true;                ///< its name is one of the scene's; no helping point of a rigid body
    Mark mark = Mark::dot;               ///< of a place without mass that is not fixed
    std::optional<std::size_t> of = {};  ///< the place of the centre of mass of its rigid body, which may be itself
  };
  enum class Joins { rod, spring, body, axis };  ///< body: two places of one rigid body; axis: of a joint
  struct Link {
    std::size_t a, b;  ///< among the places
    Joins as;
  };
  /// A rigid body that is more than links.
  struct Body {
    std::size_t place;  ///< of its centre of mass
    Displacement<double> reference;
    std::vector<Index> directors;  ///< where their coordinates begin
    Solid solid;                   ///< in the body's frame, from the reference point
  };

  int dimension = 0;
  std::vector<Place> places;
  std::vector<Link> links;
  std::vector<Body> bodies = {};
  HeldOn held_on = {};

  /// The position of place i. \param q of scene's coordinates
  std::array<double, 3> position(std::size_t i, const std::vector<double>& q) const;
  /// The corners of a body's solid.
  std::vector<std::array<double, 3>> corners(const Body& body, const std::vector<double>& q) const;
  /// Its velocity. \param v of scene's coordinates
  std::array<double, 3> velocity(std::size_t i, const std::vector<double>& v) const;
};

/// Bodies, points and rigid bodies of a scene, with its rods, joints and those of its springs that it names. A rigid
/// body has its name at its centre of mass, and its body_shape(). In the plane one without a shape of its own is a bar
/// between two points that are fastened, or the polygon of several. A line leads from the centre of mass to what is
/// fastened outside.
/// \param states of the coordinates that are drawn; those of the start if there are none
Sketch sketch(const Scene& scene, const std::vector<std::vector<double>>& states = {});

}  // namespace hbvm::core
