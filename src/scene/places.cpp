#include "scene/places.hpp"

#include "scalar/literal.hpp"
#include "scene/moving_point.hpp"

namespace hbvm::core {

template <Scalar S>
std::map<std::string, Displacement<S>, std::less<>> places_of(const Scene& scene) {
  std::map<std::string, Displacement<S>, std::less<>> places;
  Index offset = 0;
  const auto moving = [&] {
    Displacement<S> x{{{offset, S(1)}}, {}};
    offset += scene.dimension;
    return x;
  };
  const auto fixed = [&](const SceneVector& position) {
    Displacement<S> x{{}, Vector<S>(scene.dimension)};
    for (Index i = 0; i < x.shift.size(); ++i)
      x.shift[i] = evaluate<S>(position[static_cast<std::size_t>(i)], scene.constants);
    return x;
  };
  const auto director = [](const std::string& body, std::size_t i) { return body + ".d" + std::to_string(i + 1); };
  for (const ScenePoint& point : scene.points)
    if (!moves(point, scene.constants))
      places.emplace(point.name, fixed(point.position));
    else
      places.emplace(point.name, Displacement<S>{{{static_cast<Index>(first_coordinate(point, scene)), S(1)}}, {}});
  for (const SceneBody& body : scene.bodies) places.emplace(body.name, moving());
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    places.emplace(body.name, body.fixed ? fixed(body.position) : moving());
    for (std::size_t i = 0; i < body.directors.size(); ++i) places.emplace(director(body.name, i), moving());
  }
  for (const SceneAttachment& attachment : scene.attachments) {
    Displacement<S> x = places.at(attachment.of);
    for (std::size_t i = 0; i < attachment.at.size(); ++i)
      x.blocks.push_back({places.at(director(attachment.of, i)).blocks.front().offset,
                          evaluate<S>(attachment.at[i], scene.constants)});
    places.emplace(attachment.name, std::move(x));
  }
  return places;
}

#define HBVM_DEFINE(S) template std::map<std::string, Displacement<S>, std::less<>> places_of<S>(const Scene&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
