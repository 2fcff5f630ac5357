#include "scene/sketch.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

class Sketcher {
 public:
  explicit Sketcher(const Scene& scene) : scene_(scene) { sketch_.dimension = scene.dimension; }

  Sketch made() {
    for (const SceneBody& body : scene_.bodies) add({body.name, block(), true, charge(body.charge)});
    for (const SceneRigidBody& body : scene_.rigid_bodies) add(body);
    for (const SceneAttachment& attachment : scene_.attachments) add(attachment);
    for (const ScenePoint& point : scene_.points)
      add({point.name, {{}, vector(point.position)}, false, charge(point.charge)});
    for (const SceneConstraint& constraint : scene_.constraints)
      if (constraint.kind == "rod") link(constraint.pairs.at("between"), Sketch::Joins::rod);
    for (const SceneEffect& effect : scene_.effects)
      if (effect.kind == "spring" && effect.between)
        for (const auto& [a, b] : *effect.between) link({a, b}, Sketch::Joins::spring);
    return std::move(sketch_);
  }

 private:
  double number(const Expression& x) const { return evaluate<double>(x, scene_.constants); }
  double charge(const std::optional<Expression>& x) const { return x ? number(*x) : 0; }
  Vector<double> vector(const SceneVector& x) const {
    Vector<double> values(static_cast<Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) values[static_cast<Index>(i)] = number(x[i]);
    return values;
  }
  /// The next coordinates.
  Displacement<double> block() {
    const Index offset = offset_;
    offset_ += scene_.dimension;
    return {{{offset, 1}}, {}};
  }

  std::size_t add(Sketch::Place place) {
    numbers_.emplace(place.name, sketch_.places.size());
    sketch_.places.push_back(std::move(place));
    return sketch_.places.size() - 1;
  }

  void add(const SceneRigidBody& body) {
    RigidBody& added = rigid_bodies_[body.name];
    added.reference = body.fixed ? Displacement<double>{{}, vector(body.position)} : block();
    for (int d = 0; d < scene_.dimension; ++d) added.directors.push_back(block().blocks.front().offset);
    added.place = add({body.name + ".reference", added.reference, false, 0, false});
    // Where nothing is fastened to it, its directors show how it is turned.
    const auto fastened = [&](const SceneAttachment& attachment) { return attachment.of == body.name; };
    if (std::none_of(scene_.attachments.begin(), scene_.attachments.end(), fastened))
      for (int d = 0; d < scene_.dimension; ++d)
        add_point(added, body.name + ".d" + std::to_string(d + 1), Vector<double>::Unit(scene_.dimension, d), false, 0);
    add_point(added, body.name, vector(body.center), true, 0);
  }

  void add(const SceneAttachment& attachment) {
    add_point(rigid_bodies_.at(attachment.of), attachment.name, vector(attachment.at), false,
              charge(attachment.charge));
  }

  /// A rigid body: the place of its reference point, and where the coordinates of its directors begin.
  struct RigidBody {
    Displacement<double> reference;
    std::vector<Index> directors;
    std::size_t place = 0;
  };

  /// The point of a body with these coordinates in its frame, and a line to it.
  void add_point(const RigidBody& body, const std::string& name, const Vector<double>& in_frame, bool has_mass,
                 double charge) {
    Displacement<double> at = body.reference;
    for (std::size_t d = 0; d < body.directors.size(); ++d)
      if (const double x = in_frame[static_cast<Index>(d)]; x != 0) at.blocks.push_back({body.directors[d], x});
    sketch_.links.push_back({body.place, add({name, at, has_mass, charge, has_mass}), Sketch::Joins::body});
  }

  void link(const std::array<std::string, 2>& ends, Sketch::Joins as) {
    sketch_.links.push_back({numbers_.at(ends[0]), numbers_.at(ends[1]), as});
  }

  const Scene& scene_;
  Sketch sketch_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::string, RigidBody> rigid_bodies_;
  Index offset_ = 0;
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

Sketch sketch(const Scene& scene) { return Sketcher(scene).made(); }

}  // namespace hbvm::core
