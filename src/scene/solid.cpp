#include "scene/solid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace hbvm::core {
namespace {

using Point = Solid::Point;

constexpr std::size_t sides = 36;  // of what is round

Point plus(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point times(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double size_of(const Point& a) { return std::hypot(a[0], a[1], a[2]); }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit_of(const Point& a) { return times(1 / size_of(a), a); }

/// Of length 1, and outwards.
Point normal_of(const Solid& solid, const std::vector<std::size_t>& face) {
  Point sum{};
  for (std::size_t i = 0; i < face.size(); ++i)
    sum = plus(sum, cross(solid.corners[face[i]], solid.corners[face[(i + 1) % face.size()]]));
  return unit_of(sum);
}

/// The edges of its faces; between faces that go on almost straight they are not sharp.
Solid with_edges(Solid solid) {
  std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> found;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const std::vector<std::size_t>& face = solid.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::size_t a = face[i], b = face[(i + 1) % face.size()];
      found[{std::min(a, b), std::max(a, b)}].push_back(f);
    }
  }
  constexpr double straight = 3 / double{4};
  for (const auto& [ends, at] : found) {
    const double bend = inner(normal_of(solid, solid.faces[at.front()]), normal_of(solid, solid.faces[at.back()]));
    solid.edges.push_back({ends, {at.front(), at.back()}, at.size() == 1 || bend < straight});
  }
  return solid;
}

/// A point of a circle about z.
Point on_circle(double radius, std::size_t i, double z, std::size_t count = sides) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Corners i of the lower circle and sides + i of the upper one, with the wall between them.
Solid wall(double radius, double length) {
  Solid solid;
  for (const double z : {-length / 2, length / 2})
    for (std::size_t i = 0; i < sides; ++i) solid.corners.push_back(on_circle(radius, i, z));
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t next = (i + 1) % sides;
    solid.faces.push_back({i, next, sides + next, sides + i});
  }
  return solid;
}

std::vector<std::size_t> counted(std::size_t first, std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

}  // namespace

Point Solid::centre() const {
  Point sum{};
  for (const Point& corner : corners) sum = plus(sum, corner);
  return times(1 / static_cast<double>(corners.size()), sum);
}

double Solid::radius() const {
  const Point middle = centre();
  double greatest = 0;
  for (const Point& corner : corners) greatest = std::max(greatest, size_of(minus(corner, middle)));
  return greatest;
}

bool Solid::shows(const Edge& edge, const std::vector<bool>& towards) const {
  const bool one = towards[edge.faces[0]], other = towards[edge.faces[1]];
  if (!closed) return edge.sharp || one != other;
  return edge.sharp ? one || other : one != other;
}

bool Solid::holds(const Point& point) const {
  const double slack = radius() / 20;
  if (!closed && faces.size() > 1) return size_of(minus(point, centre())) <= radius() + slack;
  for (const std::vector<std::size_t>& face : faces) {
    const Point normal = normal_of(*this, face);
    const double above = inner(normal, minus(point, corners[face.front()]));
    if (above > slack || (!closed && above < -slack)) return false;
    if (closed) continue;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Point &a = corners[face[i]], &b = corners[face[(i + 1) % face.size()]];
      if (inner(unit_of(cross(minus(b, a), normal)), minus(point, a)) > slack) return false;
    }
  }
  return true;
}

Solid solid_box(const Point& lengths) {
  Solid solid;
  for (const int z : {-1, 1})
    for (const int y : {-1, 1})
      for (const int x : {-1, 1}) solid.corners.push_back({x * lengths[0] / 2, y * lengths[1] / 2, z * lengths[2] / 2});
  solid.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return with_edges(std::move(solid));
}

Solid solid_cylinder(double radius, double length) {
  Solid solid = wall(radius, length);
  solid.faces.push_back(counted(sides, sides));
  solid.faces.push_back(counted(0, sides));
  std::reverse(solid.faces.back().begin(), solid.faces.back().end());
  solid = with_edges(std::move(solid));
  for (const std::size_t end : {0, 1}) {
    const std::size_t face = sides + 1 - end;
    solid.edges.push_back({{end * sides, end * sides + sides / 2}, {face, face}, true});
  }
  return solid;
}

Solid solid_disc(double radius) {
  std::vector<Point> corners;
  for (std::size_t i = 0; i < sides; ++i) corners.push_back(on_circle(radius, i, 0));
  Solid solid = solid_polygon(std::move(corners));
  solid.edges.push_back({{0, sides / 2}, {0, 0}, true});
  return solid;
}

Solid solid_ring(double radius) {
  Solid solid = wall(radius, radius / 6);
  solid.closed = false;
  return with_edges(std::move(solid));
}

Solid solid_sphere(double radius) {
  constexpr std::size_t around = 24, rows = around / 2;  // from pole to pole
  Solid solid;
  for (std::size_t row = 1; row < rows; ++row) {
    const double angle = std::numbers::pi * static_cast<double>(row) / static_cast<double>(rows);
    for (std::size_t i = 0; i < around; ++i)
      solid.corners.push_back(on_circle(radius * std::sin(angle), i, -radius * std::cos(angle), around));
  }
  const std::size_t south = solid.corners.size(), north = south + 1;
  solid.corners.push_back({0, 0, -radius});
  solid.corners.push_back({0, 0, radius});
  for (std::size_t i = 0; i < around; ++i) {
    const std::size_t next = (i + 1) % around, last = (rows - 2) * around;
    solid.faces.push_back({south, next, i});
    solid.faces.push_back({north, last + i, last + next});
    for (std::size_t row = 0; row + 2 < rows; ++row)
      solid.faces.push_back({row * around + i, row * around + next, (row + 1) * around + next, (row + 1) * around + i});
  }
  solid = with_edges(std::move(solid));
  // Its equator and two circles through the poles show how it is turned.
  const double slack = radius / 1000;
  for (Solid::Edge& edge : solid.edges) {
    const Point &a = solid.corners[edge.ends[0]], &b = solid.corners[edge.ends[1]];
    for (std::size_t axis = 0; axis < 3; ++axis)
      edge.sharp = edge.sharp || (std::abs(a[axis]) < slack && std::abs(b[axis]) < slack);
  }
  return solid;
}

Solid solid_polygon(std::vector<Point> corners) {
  Solid solid{std::move(corners)};
  solid.closed = false;
  solid.faces.push_back(counted(0, solid.corners.size()));
  return with_edges(std::move(solid));
}

Solid placed(Solid solid, const std::array<Point, 3>& axes, const Point& at) {
  for (Point& corner : solid.corners)
    corner = plus(at, plus(times(corner[0], axes[0]), plus(times(corner[1], axes[1]), times(corner[2], axes[2]))));
  return solid;
}

Solid inside_out(Solid solid) {
  for (std::vector<std::size_t>& face : solid.faces) std::reverse(face.begin(), face.end());
  return solid;
}

std::array<Point, 3> axes_about(const Point& axis) {
  // The axis is scaled first, so that no square leaves the range.
  const double greatest = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
  const Point third = unit_of(times(1 / greatest, axis));
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(third[i]) < std::abs(third[farthest])) farthest = i;
  Point first{};
  first[farthest] = 1;
  first = unit_of(minus(first, times(third[farthest], third)));
  return {first, cross(third, first), third};
}

std::vector<std::size_t> convex_hull(const std::vector<Point>& points) {
  std::vector<std::size_t> order = counted(0, points.size());
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] == points[b]; }),
      order.end());
  if (order.size() < 3) return order;
  const double width = size_of(minus(points[order.back()], points[order.front()]));
  // Points that are on a line but for rounding are on it.
  const double slack = width * width / 1'000'000;
  const auto turns_left = [&](std::size_t a, std::size_t b, std::size_t c) {
    return cross(minus(points[b], points[a]), minus(points[c], points[a]))[2] > slack;
  };
  std::vector<std::size_t> hull;
  const auto half = [&](const auto& along) {
    const std::size_t first = hull.size();
    for (const std::size_t next : along) {
      while (hull.size() > first + 1 && !turns_left(hull[hull.size() - 2], hull.back(), next)) hull.pop_back();
      hull.push_back(next);
    }
    hull.pop_back();  // where the other half begins
  };
  half(order);
  std::reverse(order.begin(), order.end());
  half(order);
  return hull;
}

}  // namespace hbvm::core
