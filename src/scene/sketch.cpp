#include "hbvm/scene/sketch.hpp"

#include <map>
#include <optional>

#include "hbvm/scalar/literal.hpp"

namespace hbvm {
namespace {

class Sketcher {
 public:
  explicit Sketcher(const Scene& scene) : scene_(scene) { sketch_.dimension = scene.dimension; }

  Sketch made() {
    for (const SceneBody& body : scene_.bodies) add({body.name, block(), true, charge(body.charge)});
    for (const SceneRigidBody& body : scene_.rigid_bodies) add(body);
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
    const Displacement<double> reference = body.fixed ? Displacement<double>{{}, vector(body.position)} : block();
    const Vector<double> center = vector(body.center);
    const std::size_t first = add({body.name, reference, false});
    Displacement<double> mass_center = reference;
    for (int a = 0; a < 3; ++a) {
      const auto director = block().blocks.front();
      Displacement<double> end = reference;
      end.blocks.push_back(director);
      sketch_.links.push_back(
          {first, add({body.name + ".d" + std::to_string(a + 1), end, false}), Sketch::Joins::body});
      if (center[a] != 0) mass_center.blocks.push_back({director.offset, center[a]});
    }
    sketch_.links.push_back({first, add({body.name + ".center", mass_center, true}), Sketch::Joins::body});
  }

  void link(const std::array<std::string, 2>& ends, Sketch::Joins as) {
    sketch_.links.push_back({numbers_.at(ends[0]), numbers_.at(ends[1]), as});
  }

  const Scene& scene_;
  Sketch sketch_;
  std::map<std::string, std::size_t> numbers_;
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

}  // namespace hbvm
