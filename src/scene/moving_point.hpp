#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// Whether an expression depends on the time: it names t, and no constant has that name.
bool names_time(const Expression& expression, const Constants& constants);
/// Whether the position of a point is given by formulas of t.
bool moves(const ScenePoint& point, const Constants& constants);

/// Whether it has forces without a potential, or t stands in a formula or the position of a point.
bool names_work(const Scene& scene);

/// The coordinates of the bodies of a scene.
std::size_t body_coordinates(const Scene& scene);
/// Where the coordinates of a moving point stand in q. After those of the bodies comes t, filled up to a point. Then
/// come the moving points in the order of the file.
std::size_t first_coordinate(const ScenePoint& moving, const Scene& scene);

/// The constants, and t = 0.
Constants at_start(Constants constants);

}  // namespace hbvm::core
