#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hbvm::core {

/// A body as it is drawn: flat faces, and edges between them.
struct Solid {
  using Point = std::array<double, 3>;
  struct Edge {
    std::array<std::size_t, 2> ends;   ///< among the corners
    std::array<std::size_t, 2> faces;  ///< at its sides; one twice where there is no other
    bool sharp;                        ///< seen wherever one of its faces is; else only as part of the outline
  };

  std::vector<Point> corners = {};
  std::vector<std::vector<std::size_t>> faces = {};  ///< their corners, anticlockwise seen from outside
  std::vector<Edge> edges = {};
  bool closed = true;  ///< the faces enclose it; else both sides of them are seen

  /// The mean of the corners.
  Point centre() const;
  /// The greatest distance of a corner from the centre.
  double radius() const;
  /// Whether an edge is seen. \param towards which faces look to who sees it
  bool shows(const Edge& edge, const std::vector<bool>& towards) const;
  /// Whether a point is within it, or next to it; of a ring, within the sphere about it.
  bool holds(const Point& point) const;
};

/// About the origin, its edges along the axes.
Solid solid_box(const Solid::Point& lengths);
/// About the origin, along z; a diameter on each end shows how it is turned.
Solid solid_cylinder(double radius, double length);
/// A flat one across z, likewise.
Solid solid_disc(double radius);
/// A narrow band about z.
Solid solid_ring(double radius);
Solid solid_sphere(double radius);
/// A flat one in the plane z = 0. \param corners anticlockwise
Solid solid_polygon(std::vector<Solid::Point> corners);

/// The solid with axis i along axes[i], which are of length 1 and across each other, and moved.
Solid placed(Solid solid, const std::array<Solid::Point, 3>& axes, const Solid::Point& at);

/// The solid seen in a mirror-image frame, whose faces would otherwise be inside out.
Solid inside_out(Solid solid);

/// Such axes, the third of them in this direction. \param axis not 0
std::array<Solid::Point, 3> axes_about(const Solid::Point& axis);

/// The corners of the smallest convex polygon about points of the plane z = 0, anticlockwise, by their numbers. Points
/// on one line have two.
std::vector<std::size_t> convex_hull(const std::vector<Solid::Point>& points);

}  // namespace hbvm::core
