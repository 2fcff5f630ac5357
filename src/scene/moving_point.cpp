#include "scene/moving_point.hpp"

#include <algorithm>

namespace hbvm::core {

bool names_time(const Expression& expression, const Constants& constants) {
  return !constants.contains("t") && expression.names().contains("t");
}

bool moves(const ScenePoint& point, const Constants& constants) {
  return std::ranges::any_of(point.position, [&](const Expression& e) { return names_time(e, constants); });
}

bool names_work(const Scene& scene) {
  const Constants& constants = scene.constants;
  const auto timed = [&](const std::optional<SceneFormula>& formula) {
    return formula && names_time(formula->expression, constants);
  };
  return std::ranges::any_of(scene.points, [&](const ScenePoint& point) { return moves(point, constants); }) ||
         std::ranges::any_of(scene.constraints, [&](const SceneConstraint& c) { return timed(c.formula); }) ||
         std::ranges::any_of(scene.effects,
                             [&](const SceneEffect& e) { return !e.formulas.empty() || timed(e.formula); });
}

std::size_t body_coordinates(const Scene& scene) {
  const auto d = static_cast<std::size_t>(scene.dimension);
  std::size_t points = scene.bodies.size();
  for (const SceneRigidBody& body : scene.rigid_bodies) points += body.fixed ? d : d + 1;
  return points * d;
}

std::size_t first_coordinate(const ScenePoint& moving, const Scene& scene) {
  std::size_t before = 1;
  for (const ScenePoint& point : scene.points) {
    if (point.name == moving.name) break;
    before += moves(point, scene.constants) ? 1 : 0;
  }
  return body_coordinates(scene) + before * static_cast<std::size_t>(scene.dimension);
}

Constants at_start(Constants constants) {
  constants.try_emplace("t", Expression::parse("0"));
  return constants;
}

}  // namespace hbvm::core
