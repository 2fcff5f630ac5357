#include "scene/sketch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "scalar/literal.hpp"
#include "scene/body_shape.hpp"
#include "scene/moving_point.hpp"

namespace hbvm::core {
namespace {

class Sketcher {
 public:
  explicit Sketcher(const Scene& scene) : scene_(scene) { sketch_.dimension = scene.dimension; }

  Sketch made(const std::vector<std::vector<double>>& states) {
    for (const SceneBody& body : scene_.bodies) add({body.name, block(body.position), true, charge(body.charge)});
    for (const SceneRigidBody& body : scene_.rigid_bodies) add(body);
    for (const SceneAttachment& attachment : scene_.attachments) add(attachment);
    add_points();
    for (const SceneRigidBody& body : scene_.rigid_bodies) give_shape(body);
    for (const SceneConstraint& constraint : scene_.constraints) {
      const auto between = constraint.pairs.find("between");
      if (between == constraint.pairs.end()) continue;
      if (constraint.kind == "rod")
        link(between->second, Sketch::Joins::rod);
      else
        add_joint(constraint, between->second);
    }
    for (const SceneEffect& effect : scene_.effects)
      if (effect.kind == "spring" && effect.between)
        for (const auto& [a, b] : *effect.between) link({a, b}, Sketch::Joins::spring);
    sketch_.held_on = held_on(scene_, states.empty() ? std::vector<std::vector<double>>{start_} : states);
    return std::move(sketch_);
  }

 private:
  /// Points that move follow after t, which stands as a point after the bodies.
  void add_points() {
    const Constants constants = at_start(scene_.constants);
    bool timed = false;
    for (const ScenePoint& point : scene_.points) {
      Displacement<double> x;
      Vector<double> start(static_cast<Index>(point.position.size()));
      for (std::size_t i = 0; i < point.position.size(); ++i)
        start[static_cast<Index>(i)] = evaluate<double>(point.position[i], constants);
      if (moves(point, scene_.constants)) {
        if (!std::exchange(timed, true)) start_.insert(start_.end(), point.position.size(), 0);
        x.blocks.push_back({static_cast<Index>(first_coordinate(point, scene_)), 1});
        start_.insert(start_.end(), start.begin(), start.end());
      } else {
        x.shift = start;
      }
      add({point.name, std::move(x), false, charge(point.charge)});
    }
  }

  /// A rigid body: where the coordinates of its directors begin, and what is fastened to it.
  struct RigidBody {
    Displacement<double> reference;
    std::vector<Index> directors;
    std::size_t place = 0;
    std::vector<std::pair<std::size_t, Solid::Point>> fastened = {};  ///< places, and where in its frame
    double radius = 0;
  };

  double number(const Expression& x) const { return evaluate<double>(x, scene_.constants); }
  double charge(const std::optional<Expression>& x) const { return x ? number(*x) : 0; }
  Vector<double> vector(const SceneVector& x) const {
    Vector<double> values(static_cast<Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) values[static_cast<Index>(i)] = number(x[i]);
    return values;
  }
  /// The next coordinates, and where they start.
  Displacement<double> block(const SceneVector& start) {
    const auto offset = static_cast<Index>(start_.size());
    for (const Expression& x : start) start_.push_back(number(x));
    return {{{offset, 1}}, {}};
  }

  std::size_t add(Sketch::Place place) {
    numbers_.emplace(place.name, sketch_.places.size());
    sketch_.places.push_back(std::move(place));
    return sketch_.places.size() - 1;
  }

  void add(const SceneRigidBody& body) {
    RigidBody& added = rigid_bodies_[body.name];
    added.reference = body.fixed ? Displacement<double>{{}, vector(body.position)} : block(body.position);
    for (const SceneVector& director : body.directors) added.directors.push_back(block(director).blocks.front().offset);
    added.place = add({body.name, point_of(added, vector(body.center)), true, 0, true});
    sketch_.places[added.place].of = added.place;
    if (!body.fixed) return;
    const std::size_t reference = add({body.name + ".reference", added.reference, false, 0, false});
    sketch_.places[reference].of = added.place;
    added.fastened.emplace_back(reference, Solid::Point{});
  }

  void add(const SceneAttachment& attachment) {
    RigidBody& body = rigid_bodies_.at(attachment.of);
    const Vector<double> at = vector(attachment.at);
    const std::size_t place = add({attachment.name, point_of(body, at), false, charge(attachment.charge), false});
    sketch_.places[place].of = body.place;
    of_[attachment.name] = &body;
    if (!is_direction(attachment.name)) body.fastened.emplace_back(place, in_space(at));
  }

  static Solid::Point in_space(const Vector<double>& x) {
    Solid::Point result{};
    std::copy(x.begin(), x.end(), result.begin());
    return result;
  }

  /// Whether nothing but an angle names the point: it is a way to say a direction.
  bool is_direction(const std::string& name) const {
    bool result = false;
    for (const SceneConstraint& c : scene_.constraints)
      for (const auto& [key, pair] : c.pairs) {
        if (std::find(pair.begin(), pair.end(), name) == pair.end()) continue;
        if (c.kind != "angle") return false;
        result = true;
      }
    return result;
  }

  /// The point of a body with these coordinates in its frame.
  static Displacement<double> point_of(const RigidBody& body, const Vector<double>& in_frame) {
    Displacement<double> at = body.reference;
    for (std::size_t d = 0; d < body.directors.size(); ++d)
      if (const double x = in_frame[static_cast<Index>(d)]; x != 0) at.blocks.push_back({body.directors[d], x});
    return at;
  }

  void give_shape(const SceneRigidBody& body) {
    RigidBody& drawn = rigid_bodies_.at(body.name);
    std::vector<Solid::Point> points;
    for (const auto& [place, at] : drawn.fastened) points.push_back(at);
    const std::vector<std::size_t> hull = convex_hull(points);
    const bool by_points = scene_.dimension == 2 && !body.shape && hull.size() > 1;
    if (by_points && hull.size() == 2) {
      sketch_.links.push_back({drawn.fastened[hull[0]].first, drawn.fastened[hull[1]].first, Sketch::Joins::body});
      return;
    }
    std::vector<Solid::Point> corners;
    for (const std::size_t i : hull) corners.push_back(points[i]);
    Solid solid = by_points ? solid_polygon(std::move(corners)) : body_shape(body, scene_.constants, extent());
    for (const auto& [place, at] : drawn.fastened)
      if (!solid.holds(at)) sketch_.links.push_back({drawn.place, place, Sketch::Joins::body});
    if (scene_.dimension == 3 && is_left_handed(drawn)) solid = inside_out(std::move(solid));
    drawn.radius = solid.radius();
    sketch_.bodies.push_back({drawn.place, drawn.reference, drawn.directors, std::move(solid)});
  }

  bool is_left_handed(const RigidBody& body) const {
    Eigen::Matrix3d directors;
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j)
        directors(i, j) = start_[static_cast<std::size_t>(body.directors[static_cast<std::size_t>(i)] + j)];
    return directors.determinant() < 0;
  }

  /// The longest edge of the box about all places at the start.
  double extent() const {
    SpaceBox box{sketch_.position(0, start_), sketch_.position(0, start_)};
    for (std::size_t i = 1; i < sketch_.places.size(); ++i) {
      const std::array<double, 3> x = sketch_.position(i, start_);
      for (std::size_t j = 0; j < 3; ++j) {
        box.low[j] = std::min(box.low[j], x[j]);
        box.high[j] = std::max(box.high[j], x[j]);
      }
    }
    return box.longest();
  }

  /// Marks at its ends, and a short line along its axis, which is fixed to the first.
  void add_joint(const SceneConstraint& constraint, const std::array<std::string, 2>& ends) {
    double radius = 0;
    for (const std::string& end : ends) {
      const auto of = of_.find(end);
      if (of == of_.end()) continue;
      sketch_.places[numbers_.at(end)].mark = Sketch::Place::Mark::joint;
      if (radius == 0 || of->second->radius < radius) radius = of->second->radius;
    }
    const auto axis = constraint.vectors.find("axis");
    if (axis == constraint.vectors.end() || scene_.dimension != 3) return;
    constexpr double share = 4 / double{5};
    const Solid::Point direction = axes_about(in_space(vector(axis->second)))[2];
    std::array<std::size_t, 2> line{};
    for (const std::size_t side : {0, 1}) {
      const double half = (side == 0 ? -share : share) * radius;
      Displacement<double> at = sketch_.places[numbers_.at(ends[0])].at;
      const auto of = of_.find(ends[0]);
      if (of == of_.end() && at.shift.size() == 0) return;  // a body of [[body]] has no directions
      for (std::size_t i = 0; i < 3; ++i)
        if (of == of_.end())
          at.shift[static_cast<Index>(i)] += half * direction[i];
        else if (direction[i] != 0)
          at.blocks.push_back({of->second->directors[i], half * direction[i]});
      line[side] = sketch_.places.size();
      sketch_.places.push_back({ends[0] + ".axis", at, false, 0, false, Sketch::Place::Mark::none});
    }
    sketch_.links.push_back({line[0], line[1], Sketch::Joins::axis});
  }

  void link(const std::array<std::string, 2>& ends, Sketch::Joins as) {
    sketch_.links.push_back({numbers_.at(ends[0]), numbers_.at(ends[1]), as});
  }

  const Scene& scene_;
  Sketch sketch_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::string, RigidBody> rigid_bodies_;
  std::map<std::string, const RigidBody*> of_;  ///< the bodies of attachments
  std::vector<double> start_;
};

}  // namespace

std::array<double, 3> Sketch::position(std::size_t i, const std::vector<double>& q) const {
  const Vector<double> at =
      displaced(places[i].at, dimension,
                Vector<double>(Eigen::Map<const Vector<double>>(q.data(), static_cast<Index>(q.size()))));
  std::array<double, 3> result{};
  for (Index j = 0; j < dimension; ++j) result[static_cast<std::size_t>(j)] = at[j];
  return result;
}

std::array<double, 3> Sketch::velocity(std::size_t i, const std::vector<double>& v) const {
  std::array<double, 3> result{};
  for (const auto& block : places[i].at.blocks)
    for (Index j = 0; j < dimension; ++j)
      result[static_cast<std::size_t>(j)] += block.weight * v[static_cast<std::size_t>(block.offset + j)];
  return result;
}

std::vector<std::array<double, 3>> Sketch::corners(const Body& body, const std::vector<double>& q) const {
  std::vector<std::array<double, 3>> result;
  const auto& blocks = body.reference.blocks;
  for (const Solid::Point& corner : body.solid.corners) {
    std::array<double, 3>& x = result.emplace_back();
    for (std::size_t j = 0; j < static_cast<std::size_t>(dimension); ++j) {
      x[j] = blocks.empty() ? body.reference.shift[static_cast<Index>(j)]
                            : q[static_cast<std::size_t>(blocks.front().offset) + j];
      for (std::size_t a = 0; a < body.directors.size(); ++a)
        x[j] += corner[a] * q[static_cast<std::size_t>(body.directors[a]) + j];
    }
  }
  return result;
}

Sketch sketch(const Scene& scene, const std::vector<std::vector<double>>& states) {
  return Sketcher(scene).made(states);
}

}  // namespace hbvm::core
